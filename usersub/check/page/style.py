# SPDX-License-Identifier: MIT
"""Style sheet of the page: narrow or wide, light or dark, on paper or in grey."""

STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --paper: #ffffff; --soft: #f2f4f6;
  --line: #c4cad0; --bad: #a33b00; --weak: #555e66; --link: #00518a; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8e8; --paper: #16191c; --soft: #22272c; --line: #4a525a; --bad: #ff9d5c;
    --weak: #a9b2ba; --link: #8cc4f0; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 1rem 1.25rem 3rem; color: var(--ink);
  background: var(--paper); font: 1rem/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0.5rem 0; }
h2 { font-size: 1.4rem; margin: 2.5rem 0 0.5rem; padding-top: 0.6rem;
  border-top: 3px solid var(--ink); }
h3 { font-size: 1.15rem; margin: 1.8rem 0 0.4rem; }
h4 { font-size: 1rem; margin: 1.2rem 0 0.3rem; }
a { color: var(--link); }
p { margin: 0.4rem 0; max-width: 46rem; }
.verdict { font-weight: 600; font-size: 1.1rem; }
.weak, caption, figcaption { color: var(--weak); font-size: 0.92rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 0.5rem 0; font-size: 0.92rem; }
caption { text-align: left; padding-bottom: 0.25rem; white-space: nowrap; }
th, td { border: 1px solid var(--line); padding: 0.25rem 0.55rem; text-align: left;
  vertical-align: top; overflow-wrap: break-word; }
th { font-weight: 600; }
thead th { background: var(--soft); }
tbody th { white-space: nowrap; }
.reasons tbody th { white-space: normal; font-weight: 400; overflow-wrap: anywhere; }
.numbers td { text-align: right; font-variant-numeric: tabular-nums; }
.mark { white-space: nowrap; }
.fail { font-weight: 700; color: var(--bad); }
.failure { border: 1px solid var(--line); border-left: 6px solid var(--bad); border-radius: 4px;
  padding: 0.2rem 1rem 0.8rem; margin: 1rem 0; }
.light { border-left-color: var(--weak); }
.failure h4 { font-size: 1.1rem; margin-top: 0.6rem; }
.failure h5 { font-size: 0.95rem; margin: 0.9rem 0 0.2rem; }
.found { font-size: 1.05rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.2rem 1rem; margin: 0.5rem 0; }
dt { font-weight: 600; }
dd { margin: 0; overflow-wrap: anywhere; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace;
  font-size: 0.88rem; }
pre { background: var(--soft); border: 1px solid var(--line); border-radius: 4px;
  padding: 0.5rem 0.75rem; overflow-x: auto; margin: 0.3rem 0; white-space: pre-wrap;
  overflow-wrap: anywhere; }
pre.source { white-space: pre; overflow-wrap: normal; }
figure { margin: 0.5rem 0; }
figure div { background: #ffffff; border: 1px solid var(--line); border-radius: 4px;
  padding: 0.4rem; overflow-x: auto; width: fit-content; max-width: 100%; }
figure svg { display: block; max-width: 100%; height: auto; min-width: 24rem;
  font-family: "DejaVu Sans", Verdana, Geneva, sans-serif; }
figure svg * { stroke-linejoin: round; stroke-linecap: butt; }
.instead p { font-style: italic; }
@media (max-width: 40rem) { dl { grid-template-columns: 1fr; } dd { margin-bottom: 0.4rem; } }
@media print {
  :root { --ink: #000000; --paper: #ffffff; --soft: #f4f4f4; --line: #999999; --bad: #000000;
    --weak: #333333; --link: #000000; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  figure, .failure h4, tr { break-inside: avoid; }
  pre.source { white-space: pre-wrap; }
  nav { display: none; }
}
"""
