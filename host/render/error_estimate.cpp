// Batch means and a prediction bound.
//
// The expected error. Passes x_i of a value are independent with variances v_i and one mean. Then
// E sum (x_i - mean)^2 = (1 - 1/n) sum v_i, so that s^2/n, the film's own estimate, has the
// expectation sum v_i / n^2 = Var(mean) exactly, whether passes are alike or not (those of merging
// are not: v_i grows as the radius shrinks). If the means differ, too (the bias of merging falls),
// sum (m_i - m)^2 / (n (n - 1)) is added: too much, never too little.
//
// Its weights. relMSE divides by the squared true value, and the mean stands in for that. But a
// bright path that few pixels have met raises the mean of just those, which hides their error: with
// l << 1 hits expected per pixel the estimate comes out as l in place of 1/l. So a second estimate
// weighs the deviation of each group by the mean of all the others, which do not know of it; the
// larger one counts.
//
// Its spread. One film's relMSE strays from what is expected, by less the more independent values
// it has. Deviations of groups have the spread of a film's error, or more since means of fewer
// passes are less normal, and they know of all that values share: photons, splats, light paths.
// The logarithm of a sum of squares is nearly normal (its upper tail is shorter: chi^2 has
// log-density linear there), so that the error of this film is one more draw beside those of G
// groups: exp(t_{G-1} sqrt(ln(1 + s^2)) sqrt(1 + 1/G)) times as large at most. G groups may agree
// by luck, so s is at least what it would be if pixels were independent: with few pixels that carry
// all, it is large, and the render goes on.
//
// Looks. The k-th may fail with probability a / (k (k + 1)), which add up to less than a.
#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/relmse.h"
#include "base/statistics.h"
#include "render/sampler.h"

namespace pellucid {
namespace {

constexpr std::size_t least_groups = 4, most_groups = 16;
/// Pixels that groups know: enough for the spread of any error, and no more memory than a film of
/// so many.
constexpr std::size_t most_kept = std::size_t{1} << 20;

/// All pixels, or one in each cell of k x k, at random so that no pattern of the picture aligns.
std::vector<std::size_t> kept_pixels(const Window& window) {
  const auto cells = [](int size, int k) { return std::size_t((size + k - 1) / k); };
  int k = 1;
  while (cells(window.width, k) * cells(window.height, k) > most_kept) ++k;
  std::vector<std::size_t> kept;
  for (int y = 0; y < window.height; y += k)
    for (int x = 0; x < window.width; x += k) {
      const uint hash = hash_seed(std::uint64_t(y) << 32 | std::uint64_t(x));
      const int dx = int((hash & 0xffffu) % uint(std::min(k, window.width - x)));
      const int dy = int((hash >> 16) % uint(std::min(k, window.height - y)));
      kept.push_back(std::size_t(y + dy) * std::size_t(window.width) + std::size_t(x + dx));
    }
  return kept;
}

/// Squared deviations of each group from all the others, relative to these.
struct Deviations {
  std::vector<double> of_group;  ///< sums over pixels
  double sum = 0, square = 0;    ///< over groups and pixels
};

Deviations deviations(const std::vector<std::vector<float>>& groups, double epsilon) {
  Deviations out;
  out.of_group.resize(groups.size());
  for (std::size_t i = 0; i < groups.front().size(); i += 3) {
    double total[3] = {};
    for (const std::vector<float>& group : groups)
      for (std::size_t c = 0; c < 3; ++c) total[c] += double(group[i + c]);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      double sum = 0;  // channels of a pixel vary together
      for (std::size_t c = 0; c < 3; ++c) {
        const double x = double(groups[g][i + c]);
        const double others = (total[c] - x) / double(groups.size() - 1);
        sum += (x - others) * (x - others) / (others * others + epsilon * epsilon);
      }
      out.of_group[g] += sum;
      out.sum += sum;
      out.square += sum * sum;
    }
  }
  return out;
}

/// Relative variance of `values`.
double relative_variance(const std::vector<double>& values) {
  const double n = double(values.size());
  double sum = 0, square = 0;
  for (double v : values) sum += v;
  for (double v : values) square += (v - sum / n) * (v - sum / n);
  return sum > 0 ? square / (n - 1) / ((sum / n) * (sum / n)) : 0;
}

}  // namespace

std::uint64_t ErrorEstimate::host_bytes(std::uint64_t pixels) {
  return std::min<std::uint64_t>(pixels, most_kept) * 3 *
         (most_groups * sizeof(float) + 2 * sizeof(double));
}

ErrorEstimate::ErrorEstimate(double target, const Film& film, double least_effective)
    : target_(target),
      least_effective_(least_effective),
      unit_(film.block_size),
      kept_(kept_pixels(film.window)),
      passes_(film.passes.count()),
      sums_(sums(film)),
      next_look_(std::max<std::uint64_t>(least_groups * unit_, most_groups)) {
  PELLUCID_CHECK(target > 0, "an error to reach");
  while (next_look_ <= passes_) next_look_ *= 2;
  size_ = std::max<std::uint64_t>(unit_, next_look_ / most_groups);
}

void ErrorEstimate::recall(double upper_root) {
  ErrorLook look;
  look.passes = passes_;
  look.relmse = look.expected = std::numeric_limits<double>::quiet_NaN();
  look.upper = upper_root * upper_root;
  looks_.push_back(look);
}

std::uint64_t ErrorEstimate::border() const {
  return (passes_ / size_ + 1) * size_;
}

std::vector<double> ErrorEstimate::sums(const Film& film) const {
  std::vector<double> sums;
  sums.reserve(3 * kept_.size());
  for (const std::size_t pixel : kept_)
    for (const double sum : film.sums(pixel).sum) sums.push_back(sum);
  return sums;
}

void ErrorEstimate::observe(const Film& film) {
  const std::uint64_t due = border();
  PELLUCID_CHECK(film.passes.count() == due, "films are shown at borders of groups");
  std::vector<double> now = sums(film);
  if (due - passes_ == size_) {  // else an earlier render has begun it
    if (groups_.empty()) first_group_ = passes_ / size_;
    std::vector<float> mean(now.size());
    for (std::size_t i = 0; i < now.size(); ++i)
      mean[i] = float((now[i] - sums_[i]) / double(size_));
    groups_.push_back(std::move(mean));
  }
  sums_ = std::move(now);
  passes_ = due;
  if (due < next_look_) return;
  look(film);
  next_look_ *= 2;
  if (next_look_ > most_groups * size_) join_pairs();
}

void ErrorEstimate::join_pairs() {
  std::vector<std::vector<float>> pairs;
  // The first may have its partner in an earlier render.
  for (std::size_t g = first_group_ % 2; g + 1 < groups_.size(); g += 2) {
    for (std::size_t i = 0; i < groups_[g].size(); ++i)
      groups_[g][i] = 0.5f * (groups_[g][i] + groups_[g + 1][i]);
    pairs.push_back(std::move(groups_[g]));
  }
  groups_ = std::move(pairs);
  first_group_ = (first_group_ + 1) / 2;
  size_ *= 2;
}

void ErrorEstimate::finish(const Film& film) {
  if (looks_.empty() || looks_.back().passes < film.passes.count()) look(film);
}

void ErrorEstimate::look(const Film& film) {
  if (groups_.size() < least_groups) return;
  const FilmSummary film_says = summarise(film);
  const double epsilon = RELMSE_EPSILON * film_says.mean, n = double(groups_.size());
  ErrorLook now;
  now.passes = film.passes.count();
  now.groups = groups_.size();
  now.relmse = now.expected = film_says.relmse;
  now.upper = std::numeric_limits<double>::infinity();
  if (film_says.mean > 0 && std::isfinite(film_says.relmse)) {
    const double pixels = double(kept_.size());
    const Deviations d = deviations(groups_, epsilon);
    // A group's deviation from the others has n / (n - 1) times its variance.
    const double of_group = d.sum / (3 * n * pixels) * (n - 1) / n;
    now.expected = std::max(now.relmse, of_group * double(size_) / double(now.passes));
    now.effective = d.sum > 0 ? d.sum * d.sum / d.square : 0;
    const double if_independent = d.sum > 0 ? (n * pixels / now.effective - 1) / pixels : 0;
    const double spread2 = std::max(relative_variance(d.of_group), if_independent);
    now.spread = std::sqrt(spread2);
    const double k = double(looks_.size() + 1);
    const double alpha = (1 - confidence) / (k * (k + 1));
    const double t = student_quantile(1 - alpha, n - 1);
    if (now.effective >= least_effective_)
      now.upper = now.expected * std::exp(t * std::sqrt(std::log1p(spread2) * (1 + 1 / n)));
  }
  looks_.push_back(now);
}

bool ErrorEstimate::reached() const {
  return !looks_.empty() && looks_.back().upper <= target_ * target_;
}

std::uint64_t ErrorEstimate::likely_end(const FilmSummary& now) const {
  double margin = 1;
  if (!looks_.empty() && looks_.back().groups > 0)
    margin = looks_.back().upper / looks_.back().relmse;
  const double passes = double(now.iterations) * now.relmse * margin / (target_ * target_);
  if (!(passes < 0x1p32)) return 0;  // nor if there is no estimate
  std::uint64_t look = next_look_;
  while (double(look) < passes) look *= 2;
  return look;
}

}  // namespace pellucid
