# SPDX-License-Identifier: MIT
"""Style sheet of the study's page: narrow or wide, light or dark, on paper or in grey."""

STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --paper: #ffffff; --soft: #f2f4f6;
  --line: #c4cad0; --weak: #555e66; --link: #00518a; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8e8; --paper: #16191c; --soft: #22272c; --line: #4a525a; --weak: #a9b2ba;
    --link: #8cc4f0; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 62rem; padding: 1rem 1.25rem 3rem; color: var(--ink);
  background: var(--paper); font: 1rem/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0.5rem 0; }
h2 { font-size: 1.4rem; margin: 2.5rem 0 0.5rem; padding-top: 0.6rem;
  border-top: 3px solid var(--ink); }
h3 { font-size: 1.15rem; margin: 1.8rem 0 0.4rem; }
a { color: var(--link); }
p, ul { margin: 0.4rem 0; max-width: 48rem; }
ul { padding-left: 1.3rem; }
caption, figcaption, summary { color: var(--weak); font-size: 0.92rem; }
figcaption { max-width: 48rem; margin: 0.3rem 0 1.2rem; }
summary { cursor: pointer; margin: 0.6rem 0; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 0.5rem 0 1rem; font-size: 0.9rem; }
caption { text-align: left; padding-bottom: 0.25rem; }
th, td { border: 1px solid var(--line); padding: 0.2rem 0.5rem; text-align: left;
  vertical-align: top; overflow-wrap: break-word; }
thead th { background: var(--soft); font-weight: 600; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.2rem 1rem; margin: 0.5rem 0; }
dt { font-weight: 600; }
dd { margin: 0; overflow-wrap: anywhere; }
nav ul { columns: 2; max-width: none; }
figure { margin: 0.8rem 0 0; }
figure div { background: #ffffff; border: 1px solid var(--line); border-radius: 4px;
  padding: 0.4rem; overflow-x: auto; width: fit-content; max-width: 100%; }
figure svg { display: block; max-width: 100%; height: auto; min-width: 24rem;
  font-family: "DejaVu Sans", Verdana, Geneva, sans-serif; }
figure svg * { stroke-linejoin: round; stroke-linecap: butt; }
@media (max-width: 40rem) { dl { grid-template-columns: 1fr; } nav ul { columns: 1; } }
@media print {
  :root { --ink: #000000; --paper: #ffffff; --soft: #f4f4f4; --line: #999999; --weak: #333333;
    --link: #000000; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  figure, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  nav, details { display: none; }
  .wide { overflow-x: visible; }
  table { font-size: 7pt; }
  th, td { padding: 1pt 3pt; overflow-wrap: anywhere; }
}
"""
