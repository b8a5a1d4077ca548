// Reports of a study: what they say, that they are sound markup, and that study.json brings them
// back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "study/report/facts.h"
#include "study/report/html.h"
#include "study/report/svg.h"
#include "study/report/table.h"
#include "study/report/text.h"
#include "study/study_json.h"
#include "support/sample_study.h"

namespace pellucid {
namespace {

using nlohmann::json;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// The line that begins so; "" if there is none.
std::string line_of(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find("\n" + begin);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

/// Empty if every element is closed in its turn and every "<" and "&" is markup; else what is not.
std::string unsound(const std::string& page) {
  std::vector<std::string> open;
  const std::string body = page.substr(page.find("<html"));
  for (std::size_t at = 0; at < body.size(); ++at) {
    if (body[at] == '&') {
      const std::string entity = body.substr(at, body.find(';', at) + 1 - at);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;" &&
          entity != "&#160;")
        return "entity " + entity.substr(0, 20);
    }
    if (body[at] != '<') continue;
    const std::size_t end = body.find('>', at);
    if (end == std::string::npos) return "a tag that does not end";
    const std::string tag = body.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos || count(tag, "\"") % 2) return "tag " + tag;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "end " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "open " + open.back();
}

/// A word of its own: "nan" is in no name, "inf" begins "info".
bool says(const std::string& text, const std::string& word) {
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !letter(text[at - 1])) && (end == text.size() || !letter(text[end])))
      return true;
  }
  return false;
}

void expect_sound(const Study& study) {
  const std::string page = study_html(study), table = study_table(study);
  EXPECT_EQ(unsound(page), "");
  for (const char* word : {"nan", "inf", "-nan", "NaN", "Infinity", "-0.0"}) {
    EXPECT_FALSE(says(page, word)) << word;
    EXPECT_FALSE(says(table, word)) << word;
  }
  // Nothing is loaded and nothing runs.
  for (const char* part : {"http:", "https:", "<script", "@import", "<link", "<iframe", "src=\"/"})
    EXPECT_EQ(count(page, part), 0u) << part;
  EXPECT_EQ(count(page, "url("), count(page, "url(#"));
  EXPECT_EQ(count(page, "src=\""), count(page, "src=\"data:image/png;base64,"));
}

Study round_trip(const Study& study) {
  return read_study(json::parse(study_document(study).dump()), "study.json");
}

TEST(ReportText, FewDigitsWithUnits) {
  EXPECT_EQ(digits(0), "0");
  EXPECT_EQ(digits(0.0038456), "0.0038");
  EXPECT_EQ(digits(412), "410");
  EXPECT_EQ(digits(99.7), "100");
  EXPECT_EQ(digits(-0.9649, 3), "-0.965");
  EXPECT_EQ(digits(3.14e-7), "3.1e-7");
  EXPECT_EQ(digits(2.55e9, 3), "2.55e9");
  EXPECT_EQ(digits(std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_EQ(digits(-std::numeric_limits<double>::infinity()), "-");
  EXPECT_EQ(percent(0.01, 1), "1 %");
  EXPECT_EQ(percent(0.00834), "0.83 %");
  EXPECT_EQ(duration(0.0041), "4.1 ms");
  EXPECT_EQ(duration(410), "410 s");
  EXPECT_EQ(duration(2040), "34 min");
  EXPECT_EQ(duration(86400 * 3.2), "3.2 d");
  EXPECT_EQ(duration_interval(2040, 1800, 2400), "34 min [30, 40]");
}

TEST(Svg, LabelsKeepTheirDistance) {
  const std::vector<double> at = spread({50, 51, 52, 10, 98}, 12, 0, 100);
  std::vector<double> sorted = at;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) EXPECT_GE(sorted[i] - sorted[i - 1], 12 - 1e-9);
  EXPECT_GE(sorted.front(), 0);
  EXPECT_LE(sorted.back(), 100);
  EXPECT_EQ(at[3], 10);  // nothing is near
  EXPECT_LT(at[0], at[1]);
  EXPECT_LT(at[1], at[2]);
}

TEST(Svg, LogAxis) {
  const LogAxis axis{0.1, 1000, 0, 400};
  EXPECT_DOUBLE_EQ(axis.at(1), 100);
  EXPECT_DOUBLE_EQ(axis.at(1000), 400);
  EXPECT_DOUBLE_EQ(axis.cut(1e9), 1000);
  EXPECT_DOUBLE_EQ(axis.at(-1), 0);
  std::vector<std::string> labels;
  for (const AxisTick& tick : axis.time_ticks()) labels.push_back(tick.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"0.1 s", "1 s", "10 s", "1 min", "10 min"}));
}

TEST(ReportFacts, CurveIsTheMeanWithItsInterval) {
  StudyOption option;
  for (double relmse : {1e-4, 2e-4, 3e-4}) option.runs.push_back({1, {{16, 2, relmse, 1}}});
  const std::vector<ErrorPoint> curve = error_curve(option);
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_EQ(curve[0].runs, 3);
  EXPECT_DOUBLE_EQ(*curve[0].error, std::sqrt(2e-4));
  // t(0.95; 2) = 2.919986; standard error 1e-4 / sqrt(3), of the log half of that over 1e-4.
  const double half = 2.919986 * (1e-4 / std::sqrt(3.0)) / 2e-4;
  EXPECT_NEAR(*curve[0].low, std::sqrt(2e-4 * std::exp(-half)), 1e-8);
  EXPECT_NEAR(*curve[0].high, std::sqrt(2e-4 * std::exp(half)), 1e-8);
}

TEST(ReportFacts, NoiseTakenOffMayLeaveABoundOnly) {
  StudyOption option;
  for (double relmse : {-1e-4, 5e-5, -2e-5}) option.runs.push_back({1, {{16, 2, relmse, 1}}});
  const ErrorPoint point = error_curve(option)[0];
  EXPECT_FALSE(point.error);
  ASSERT_TRUE(point.high);
  EXPECT_EQ(error_near(option, 2), "<= " + percent(*point.high));
  EXPECT_EQ(error_near(option, 4), "-");  // no rung is near
}

TEST(ReportFacts, FloorTimeIsNoiseOverBias) {
  const Study study = test::sample_study();
  const std::optional<FloorTime> known = floor_time(study, study.pairs[0]);
  ASSERT_TRUE(known);
  EXPECT_DOUBLE_EQ(known->seconds, 0.004 / 4e-6);
  EXPECT_FALSE(known->at_least);
  const std::optional<FloorTime> bounded = floor_time(study, study.pairs[2]);
  ASSERT_TRUE(bounded);
  EXPECT_DOUBLE_EQ(bounded->seconds, 0.041 / 3e-9);
  EXPECT_TRUE(bounded->at_least);
  EXPECT_FALSE(floor_time(study, study.pairs[3]));  // its noise does not fall as 1 / t
}

TEST(ReportFacts, OnlyWhatForbidsTheTargetIsAFloor) {
  Study study = test::sample_study();
  study.options[0].splits.back() = {512, 1e-4, 2e-5, 2.1e-5};
  EXPECT_FALSE(error_floor(study, 0));  // one of ten unbiased options looks so by chance
  study.verdicts[0].kind = TargetKind::never;
  ASSERT_TRUE(error_floor(study, 0));
  EXPECT_DOUBLE_EQ(*error_floor(study, 0), std::sqrt(2e-5));
  EXPECT_DOUBLE_EQ(*error_floor(study, 1), std::sqrt(4e-6));  // of its arithmetic
  EXPECT_EQ(pair_bias_text(study.pairs[0]), "0.20 %");
  EXPECT_EQ(pair_bias_text(study.pairs[3]), "none seen");
}

TEST(ReportTable, SaysEveryKindOfVerdict) {
  const std::string table = study_table(test::sample_study());
  const auto expect = [&](const char* option, const char* words) {
    EXPECT_NE(line_of(table, std::string("| ") + option).find(words), std::string::npos)
        << option << ": " << line_of(table, std::string("| ") + option);
  };
  expect("vcm strict", "| 38 s [34, 43] interpolated ");
  expect("vcm strict", "| recommended ");
  expect("vcm fast", "| no different from vcm strict ");
  expect("bdpt strict", "| 21 s [19, 24] measured ");
  expect("bdpt strict", "| its pictures have 0.9950 of the reference's light ");
  expect("path strict", "| 410 s [370, 460] extrapolated x6.8 ");
  expect("light strict", "| >= 280 s (x32 the longest run) ");
  expect("sppm strict", "| 530 s [470, 590] extrapolated x22 ");
  expect("bdpt compact", "| never (floor 1.6 %) ");
  expect("bdpt compact", "| a floor of 1.6 % ");
  expect("nee strict", "| never (cannot see all paths) ");
  expect("nee strict", "| cannot see caustics: light \\| focused by <glass> & mirrors ");
  expect("naive strict", "| unknown ");
  expect("naive strict", "| pilot only: about 140 times dearer than bdpt ");
  expect("reference strict", "| too slow: 2 of 5 rungs fit the budget ");
  expect("bpm strict", "| refused: its pictures hold pixels that are no numbers ");
}

TEST(ReportTable, RowsAndColumns) {
  Study study = test::sample_study();
  study.options[0].reason = "one | two\nthree";
  const std::string table = study_table(study);
  // A head, a line and a row for each, of options and of precisions.
  EXPECT_EQ(count(table, "\n| "), 1 + study.options.size() + 1 + study.pairs.size());
  EXPECT_EQ(count(table, "\n|--"), 2u);
  std::size_t width = 0;
  for (const StudyOption& option : study.options) {
    const std::string row = line_of(table, "| " + option.name() + " ");
    ASSERT_NE(row, "") << option.name();
    if (width == 0) width = row.size();
    EXPECT_EQ(row.size(), width) << row;  // aligned
  }
  EXPECT_NE(table.find("one \\| two three"), std::string::npos);
}

TEST(ReportTable, TheRecommendedOptionComesFirst) {
  Study study = test::sample_study();
  study.recommended = 4, study.equals = {2};
  EXPECT_EQ(ranked(study)[0], 4u);
  EXPECT_EQ(ranked(study)[1], 2u);
}

TEST(StudyDocument, RoundTrip) {
  const Study study = test::sample_study();
  const std::string text = study_document(study).dump(2);
  const Study again = round_trip(study);
  EXPECT_EQ(study_document(again).dump(2), text);
  EXPECT_EQ(study_html(again), study_html(study));
  EXPECT_EQ(study_table(again), study_table(study));
  EXPECT_EQ(again.verdicts[4].kind, TargetKind::extrapolated);
  EXPECT_EQ(again.options[7].state, OptionState::blind);
}

TEST(StudyDocument, ReadErrorsNameFileAndKey) {
  const json good = study_document(test::sample_study());
  const auto expect_error = [&](const char* pointer, const json& value, const char* word) {
    json bad = good;
    const json::json_pointer place(pointer);
    if (value.is_discarded())
      bad[place.parent_pointer()].erase(place.back());
    else
      bad[place] = value;
    try {
      read_study(bad, "a/study.json");
      FAIL() << pointer;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("a/study.json"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  const json missing(json::value_t::discarded);
  expect_error("/target", missing, "target");
  expect_error("/options/0/runs/0/rungs/0/relmse", missing, "relmse");
  expect_error("/options/2/slope", missing, "slope");
  expect_error("/width", "wide", "number");
  expect_error("/options/1/runs", 7, "array");
  expect_error("/options/0/runs/0/rungs/0/seconds", nullptr, "number");
  expect_error("/machine", missing, "machine");
  expect_error("/recommended", int(good["options"].size()), "recommended");
  expect_error("/recommended", -2, "recommended");
  expect_error("/equals", json::array({-1}), "equals");
  expect_error("/schema", 2, "schema");
}

TEST(ReportHtml, IsSoundAndComplete) {
  const Study study = test::sample_study();
  expect_sound(study);
  const std::string page = study_html(study);
  EXPECT_EQ(page, study_html(study));
  for (const char* part :
       {"Seconds to an error of 1&#160;%", "Options", "Variance and bias", "Where the time goes",
        "Precision", "Pictures", "What methods cannot see", "Every run",
        "What would change this verdict", "light | focused by &lt;glass&gt; &amp; mirrors",
        "glass caustic &lt;of a ring&gt; &amp; &quot;more&quot;", "class=\"target\""})
    EXPECT_GT(count(page, part), 0u) << part;
  // A picture and an error map of all that ran, and the reference.
  const std::size_t ran = 8;
  EXPECT_EQ(count(page, "<img "), 2 * ran + 1);
  EXPECT_EQ(count(page, "<details>"), ran);
  std::size_t rungs = 0;
  for (const StudyOption& option : study.options)
    for (const StudyRun& run : option.runs) rungs += run.rungs.size();
  EXPECT_EQ(count(page, "<tr"), rungs + ran                       // every run
                                    + 1 + study.options.size()    // options
                                    + 1 + study.pairs.size()      // precisions
                                    + 1 + 9                       // methods
                                    + 1 + study.options.size());  // counters
}

TEST(ReportHtml, DrawsSolidDashedAndDotted) {
  const std::string page = study_html(test::sample_study());
  EXPECT_EQ(count(page, "class=\"curve m-"), 7u);  // eight that ran, one of them for one rung
  EXPECT_EQ(count(page, "class=\"fit m-"), 4u);    // two extrapolated, one beyond, one never
  EXPECT_EQ(count(page, "class=\"floor m-"), 3u);  // two precisions, one blind method
  EXPECT_EQ(count(page, "class=\"band m-"), 6u);   // not from one run, nor of one rung
}

TEST(ReportHtml, AnEmptyStudyIsAPageToo) {
  expect_sound(Study{});
  Study study;
  study.options.resize(3);  // nothing ran, nothing was concluded, no names
  study.pairs.resize(1);
  expect_sound(study);
  EXPECT_EQ(count(study_html(study), "<polyline"), 0u);
}

TEST(ReportHtml, DrawsWhatIsNoNumberAsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (double bad : {nan, inf, -inf, 0.0, -1.0, 1e308, 5e-324}) {
    Study study = test::sample_study();
    study.target = bad, study.seconds = bad, study.machine.foreign_load = bad;
    study.reference.relmse = study.reference.energy_error = study.reference.disagreement = bad;
    for (StudyOption& o : study.options) {
      o.setup_seconds = o.pilot_efficiency = bad;
      for (StudyRun& run : o.runs) run.rungs.back() = {99, bad, bad, bad};
      for (Split& s : o.splits) s.variance = s.bias2 = s.bias2_upper90 = bad;
      for (PassSeconds& p : o.passes) p.seconds = bad;
    }
    for (PrecisionPair& p : study.pairs)
      p.bias2 = p.bias2_upper90 = p.time_ratio = p.time_low = p.divergent_per_million = bad;
    for (Verdict& v : study.verdicts)
      v.seconds = v.low = v.high = v.slope = v.slope_low = v.noise = v.bias = v.energy = bad;
    SCOPED_TRACE(bad);
    expect_sound(study);
  }
}

TEST(ReportHtml, AllBelowZeroOrOneRungOnly) {
  Study study = test::sample_study();
  for (StudyOption& o : study.options)
    for (StudyRun& run : o.runs)
      for (Rung& r : run.rungs) r.relmse = -1e-9;
  expect_sound(study);
  EXPECT_EQ(count(study_html(study), "class=\"curve m-"), 0u);
  study = test::sample_study();
  for (StudyOption& o : study.options)
    for (StudyRun& run : o.runs) run.rungs.resize(1);
  expect_sound(study);
}

TEST(ReportHtml, HostileWordsStayWords) {
  Study study = test::sample_study();
  const std::string hostile = "</td><script>alert(1)</script>\x01 & \"'";
  study.scene = study.settings = study.recommendation = hostile;
  study.warnings = study.would_change = {hostile};
  study.machine.device = study.reference.source = hostile;
  for (StudyOption& o : study.options) {
    o.integrator = o.precision = o.reason = o.picture = hostile;
    o.unreachable = o.chance = {hostile};
    for (PassSeconds& p : o.passes) p.name = hostile;
  }
  for (Verdict& v : study.verdicts) v.flags = {hostile};
  expect_sound(study);
}

}  // namespace
}  // namespace pellucid
