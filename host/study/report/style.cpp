// The style sheet. Colours are those of Okabe and Ito, which the colour-blind tell apart, with
// marks of different shape besides; darker or lighter ones where the page's ground needs it.
#include "study/report/style.h"

#include <fmt/format.h>

namespace pellucid {
namespace {

struct MethodLook {
  const char *name, *light, *dark;
  MarkShape mark;
};

const MethodLook looks[] = {
    {"path", "#0072b2", "#4aa3df", {0, 0}},       {"bdpt", "#d55e00", "#f0803c", {4, 45}},
    {"vcm", "#009e73", "#2cc79a", {3, 90}},       {"sppm", "#b8578f", "#dd8fbd", {4, 0}},
    {"bpm", "#7a4fb5", "#b493e6", {5, 90}},       {"light", "#c98a00", "#eab308", {3, 270}},
    {"nee", "#3d9bd0", "#7cc4ee", {6, 0}},        {"naive", "#7d5a3c", "#b99673", {3, 0}},
    {"reference", "#444444", "#cccccc", {3, 180}}};
const MethodLook other_look = {"other", "#777777", "#999999", {0, 0}};

const MethodLook& look_of(const std::string& integrator) {
  for (const MethodLook& look : looks)
    if (integrator == look.name) return look;
  return other_look;
}

const char* light_colours =
    "--ground:#ffffff;--panel:#f6f7f9;--ink:#1b1f24;--soft:#57606a;--faint:#d4d9df;"
    "--grid:#e7eaee;--alarm:#a40e26;--alarm-ground:#fdf0f1;--good:#eef6ff;";
const char* dark_colours =
    "--ground:#14171b;--panel:#1c2025;--ink:#e4e8ed;--soft:#9aa4af;--faint:#3a424b;"
    "--grid:#272d34;--alarm:#ff8b92;--alarm-ground:#33191d;--good:#182a3d;";

const char* page_rules = R"(
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--ground);color:var(--ink);font:14px/1.45 system-ui,-apple-system,"Segoe UI",
"Helvetica Neue","Liberation Sans",Arial,sans-serif;font-variant-numeric:tabular-nums}
main{max-width:1160px;margin:0 auto;padding:28px 24px 48px}
h1{font-size:15px;font-weight:600;color:var(--soft);margin:0 0 6px}
h2{font-size:16px;font-weight:650;margin:36px 0 8px;padding-top:12px;border-top:1px solid var(--faint)}
h3{font-size:13px;font-weight:650;margin:18px 0 4px}
h3:first-child{margin-top:0}
p{margin:0 0 8px;max-width:75em}
.verdict{font-size:22px;line-height:1.35;font-weight:600;margin:0 0 10px;max-width:44em;text-wrap:pretty}
.soft,figcaption,.note{color:var(--soft)}
.note,figcaption{font-size:12.5px}
.facts{color:var(--soft);font-size:13px}
.alarm{color:var(--alarm)}
.box{border-left:3px solid var(--alarm);background:var(--alarm-ground);padding:8px 14px;margin:14px 0}
.box ul{margin:0}
ul{margin:0 0 8px;padding-left:1.2em}
li{margin:2px 0}
.two{display:grid;grid-template-columns:minmax(0,1fr) 300px;gap:8px 36px}
.two h2{grid-column:1/-1}
.scroll{overflow-x:auto;margin:0 0 6px}
table{border-collapse:collapse;font-size:13px;width:100%}
th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1px solid var(--faint);vertical-align:bottom}
th,td{padding:4px 14px 4px 0;vertical-align:top}
td{border-bottom:1px solid var(--grid)}
th.n,td.n{text-align:right;white-space:nowrap}
.w{white-space:nowrap}
td.time{min-width:10.5em}
td.flags{min-width:15em}
tr.best td{background:var(--good)}
tr.grey td,tr.grey .alarm{color:var(--soft)}
.chip{display:inline-block;width:10px;height:10px;border-radius:2px;background:var(--c);margin-right:7px}
.relaxed.chip{background:none;border:2px solid var(--c)}
figure{margin:0 0 14px}
figcaption{margin-top:2px}
svg{display:block;width:100%;max-width:780px;height:auto;overflow:visible}
svg text{font-size:12px;fill:var(--ink);dominant-baseline:middle}
svg .soft{fill:var(--soft)}
svg .small{font-size:11px}
svg .strong{font-weight:650}
svg .end{text-anchor:end}
svg .mid{text-anchor:middle}
svg .halo{paint-order:stroke;stroke:var(--ground);stroke-width:4px;stroke-linejoin:round}
.grid{stroke:var(--grid);stroke-width:1}
.axis{stroke:var(--soft);stroke-width:1}
.target{stroke:var(--ink);stroke-width:1.2}
.curve,.fit,.floor,.leader{fill:none;stroke:var(--c)}
.curve{stroke-width:2;stroke-linejoin:round}
.fit{stroke-width:1.5;stroke-dasharray:6 4}
.floor{stroke-width:1.5;stroke-dasharray:1.5 3.5;stroke-linecap:round}
.leader{stroke-width:.7;opacity:.6}
.key{--c:var(--soft)}
.band{fill:var(--c);opacity:.16}
.mark{fill:var(--c);stroke:var(--ground);stroke-width:1}
.mark.relaxed{fill:var(--ground);stroke:var(--c);stroke-width:1.6}
.curve.relaxed{stroke-width:1.4}
.range{stroke:var(--c);stroke-width:3;opacity:.55}
.range.guess{stroke-dasharray:4 3}
.bar{fill:var(--c);stroke:var(--ground);stroke-width:1}
.s0{opacity:1}.s1{opacity:.72}.s2{opacity:.5}.s3{opacity:.34}.s4{opacity:.22}
.whisker{stroke:var(--ink);stroke-width:1.4}
.multiples{display:grid;grid-template-columns:repeat(auto-fill,minmax(210px,1fr));gap:12px 28px}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(230px,1fr));gap:18px 16px}
.pictures img{display:block;width:100%;height:auto;margin-bottom:4px;background:var(--panel);
image-rendering:pixelated}
.bad{opacity:.5}
details{margin:6px 0}
summary{cursor:pointer;padding:3px 0}
code{font-family:ui-monospace,"Liberation Mono",monospace;font-size:12.5px}
@media (max-width:900px){.two{grid-template-columns:minmax(0,1fr)}}
@media (max-width:640px){main{padding:16px 12px 32px}.verdict{font-size:18px}figure.wide text{font-size:15px}
figure.wide .small{font-size:13.5px}}
)";

const char* paper_rules = R"(
@page{margin:14mm}
@media print{main{max-width:none;padding:0}body{font-size:11px;-webkit-print-color-adjust:exact;
print-color-adjust:exact}figure,tr,h2,h3,.multiples svg{break-inside:avoid}h2,h3{break-after:avoid}
.scroll{overflow:visible}.verdict{font-size:18px}}
)";

std::string method_colours(bool dark) {
  std::string css;
  for (const MethodLook& look : looks)
    css += fmt::format("--{}:{};", look.name, dark ? look.dark : look.light);
  return css + fmt::format("--other:{};", dark ? other_look.dark : other_look.light);
}

}  // namespace

std::string method_class(const std::string& integrator) {
  return std::string("m-") + look_of(integrator).name;
}

std::string option_classes(const StudyOption& option) {
  return method_class(option.integrator) + (option.plain() ? "" : " relaxed");
}

MarkShape method_mark(const std::string& integrator) {
  return look_of(integrator).mark;
}

std::string style_sheet() {
  std::string css =
      "\n:root{color-scheme:light dark;" + (light_colours + method_colours(false)) + "}\n";
  // Paper is white whatever the screen.
  css += "@media screen and (prefers-color-scheme:dark){:root{" +
         (dark_colours + method_colours(true)) + "}}\n";
  for (const MethodLook& look : looks) css += fmt::format(".m-{0}{{--c:var(--{0})}}\n", look.name);
  css += ".m-other{--c:var(--other)}";
  return css + page_rules + paper_rules;
}

}  // namespace pellucid
