'use strict';
// The checks of pages see what is wrong: a page spoiled in one way fails the check that looks for
// it. unsound_pages_test.js FOLDER.

const assert = require('node:assert/strict');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { after, before, test } = require('node:test');

const { Browser } = require('./browser.js');
const checks = require('./checks.js');

const sound = fs.readFileSync(path.join(process.argv[2], 'conformance.html'), 'utf8');
const long = fs.readFileSync(path.join(process.argv[2], 'long.html'), 'utf8');
const certificate = fs.readFileSync(path.join(process.argv[2], 'certificate.html'), 'utf8');
const charts = 3;

let browser;
let folder;
before(() => {
  browser = new Browser();
  folder = fs.mkdtempSync(path.join(os.tmpdir(), 'gonio_unsound_'));
});
after(async () => {
  await browser.close();
  fs.rmSync(folder, { recursive: true });
});

/** Text with all that matches replaced; something has to match. */
function replaced(text, pattern, by) {
  assert.match(text, pattern);
  return text.replace(pattern, by);
}

const added = (html) => replaced(sound, /<\/main>/, `${html}</main>`);
const styled = (css, page = sound) => replaced(page, /<\/style>/, `${css}</style>`);
const withoutPolicy = (page) => replaced(page, /<meta http-equiv[^>]*>/, '');

const numbersSheets = (browser_, file) => checks.numbersSheets(browser_, file, 'EGL-2026-0042');

const unsound = [
  ['an error in a script', added('<script>throw new Error("no")</script>'), checks.isQuiet],
  ['a word in the console', added('<script>console.log("a")</script>'), checks.isQuiet],
  ['a picture from elsewhere', withoutPolicy(added('<img src="http://127.0.0.1:9/a.png" alt="">')),
    checks.isQuiet],
  ['a picture from elsewhere, refused', added('<img src="http://127.0.0.1:9/a.png" alt="">'),
    checks.isQuiet],
  ['a missing chart', replaced(sound, /<figure>[\s\S]*?<\/figure>/, ''), checks.drawsCharts],
  ['an empty chart', replaced(sound, /<path [^>]*>/g, ''), checks.drawsCharts],
  ['a chart that nobody sees', styled('figure svg { display: none }'), checks.drawsCharts],
  ['a link to nowhere', added('<a href="#nowhere">a</a>'), checks.leadsSomewhere],
  ['an id twice', added('<p id="clauses">a</p>'), checks.leadsSomewhere],
  ['a head without scope', replaced(sound, /<th scope="col"/, '<th'), checks.isAccessible],
  ['a chart without words', replaced(sound, /aria-label="Geometry[^"]*"/, ''), checks.isAccessible],
  ['no language', replaced(sound, / lang="en"/, ''), checks.isAccessible],
  ['links told by colour alone', styled('a { text-decoration: none }'), checks.isAccessible],
  ['a wide table', styled('table { min-width: 60rem }'), checks.fitsOnPaper],
  ['a long line', added(`<p style="white-space: pre">${'word '.repeat(99)}</p>`),
    checks.fitsOnPaper],
  ['rows that break', styled('tr { break-inside: auto !important }'), checks.fitsOnPaper],
  ['a printed filter', styled('@media print { form.filter { display: flex } }'),
    checks.fitsOnPaper],
  ['heads that stand once', styled('thead { display: table-row-group !important }', long),
    checks.repeatsHeads],
  ['sheets without numbers', replaced(certificate, /counter\(page\)/, '""'), numbersSheets],
  ['a table that is cut', styled('.whole { break-inside: auto !important }', certificate),
    numbersSheets],
  ['a filter that does nothing', replaced(sound, /row\.hidden = /, 'row.title = '), checks.filters],
  ['a filter deaf to words', replaced(sound, /words\.every\([^\n]*/, 'true;'), checks.filters],
  ['a link to a hidden row', replaced(sound, /form\.reset\(\);/, ''), checks.filters],
  ['rows that need a script', styled('tr[data-kind] { display: none }'),
    checks.worksWithoutScripts],
  ['a control that does nothing', replaced(sound, / id="filter" hidden/, ' id="filter"'),
    checks.worksWithoutScripts],
];

unsound.forEach(([what, html, check], i) => {
  test(`${what} is seen`, async () => {
    const file = path.join(folder, `${i}.html`);
    fs.writeFileSync(file, html);
    await assert.rejects(check(browser, file, charts), { code: 'ERR_ASSERTION' });
  });
});
