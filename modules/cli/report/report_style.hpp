#pragma once

namespace priamos::cli {

/// How reports look: the colours of the station's page (modules/console/page/style.css), light and dark.
inline constexpr const char* kReportStyle = R"(
:root{color-scheme:light dark;--ink:#16202a;--faint:#51606e;--line:#c9d2da;--good:#1b6e37;--bad:#a3101a;--paper:#f4f6f8;--card:#fff;
--on:#fff}
@media(prefers-color-scheme:dark){:root{--ink:#e8eef3;--faint:#a9b6c2;--line:#35424e;--good:#71d394;--bad:#ff8d8d;--paper:#12181e;
--card:#1b242d;--on:#12181e}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,"DejaVu Sans",sans-serif}
main{max-width:1180px;margin:0 auto;padding:24px 20px 48px}
header{display:flex;flex-wrap:wrap;gap:8px 20px;align-items:center;justify-content:space-between}
h1{font-size:1.6rem;margin:0}
h2{font-size:1.1rem;margin:36px 0 10px;border-bottom:2px solid var(--line);padding-bottom:6px}
.verdict{color:var(--on);padding:6px 16px;border-radius:4px;font-weight:600}
.reason{color:var(--bad);margin:8px 0 0}
.good{background:var(--good)}.bad{background:var(--bad)}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:20px 0}
.card{background:var(--card);border-radius:6px;padding:12px 14px}
.card b{display:block;font-size:1.45rem;font-variant-numeric:tabular-nums;line-height:1.25}
.card span{color:var(--faint);font-size:.86rem}
img{width:100%;max-width:860px;height:auto;display:block;border:1px solid var(--line);border-radius:6px;background:#fff}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:5px 12px;border-bottom:1px solid var(--line);white-space:nowrap}
th{color:var(--faint);font-weight:600;font-size:.86rem}
th:first-child,td:first-child,.text td,.text th{text-align:left}
.text td:last-child{white-space:normal;width:100%}
.two{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,400px),1fr));gap:8px 36px}
.sum td{font-weight:600}.other td{font-weight:600}
svg{width:100%;height:auto;display:block;margin:14px 0}
svg text{font-size:12px;fill:var(--faint)}svg .title{font-size:14px;font-weight:600;fill:var(--ink)}
svg .grid{stroke:var(--line)}svg rect.span{fill:var(--good);opacity:.14}svg text.span{fill:var(--good);font-weight:600}
figure{margin:0}figcaption{color:var(--faint);font-size:.86rem}
svg.look{background:#1b2026;border-radius:6px}svg.look line{stroke-width:3;stroke-linecap:round}
.expected{stroke:#8b96a1;stroke-dasharray:3 7}.matched{stroke:#3ddc84}.rejected{stroke:#ff6a5e}
footer{color:var(--faint);font-size:.86rem;margin-top:32px}
)";

}  // namespace priamos::cli
