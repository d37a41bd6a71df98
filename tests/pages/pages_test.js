'use strict';
// The pages that were written, in a browser: pages_test.js FOLDER.

const assert = require('node:assert/strict');
const fs = require('node:fs');
const path = require('node:path');
const { after, before, test } = require('node:test');

const { Browser } = require('./browser.js');
const checks = require('./checks.js');

const folder = process.argv[2];
const inFolder = (name) => path.join(folder, name);
const charts = { 'conformance.html': 3, 'long.html': 3, 'hostile.html': 3, 'measurement.html': 9,
  'certificate.html': 8, 'shipped/certificate.html': 12, 'hostile_certificate.html': 8,
  'qa.html': 20, 'qa_many.html': 20, 'hostile_qa.html': 20, 'qa_history.html': 6,
  'hostile_qa_history.html': 4 };

let browser;
before(() => { browser = new Browser(); });
after(() => browser.close());

for (const [name, count] of Object.entries(charts)) {
  const file = inFolder(name);
  test(`${name} is quiet`, () => checks.isQuiet(browser, file));
  test(`${name} draws its charts`, () => checks.drawsCharts(browser, file, count));
  test(`${name} is accessible`, () => checks.isAccessible(browser, file));
  test(`${name} fits on paper`, () => checks.fitsOnPaper(browser, file));
  test(`${name} works without scripts`, () => checks.worksWithoutScripts(browser, file));
  if (!name.startsWith('hostile')) {  // all its ids are made from one text
    test(`${name} leads somewhere`, () => checks.leadsSomewhere(browser, file));
  }
}

test('conformance.html can be filtered', () =>
  checks.filters(browser, inFolder('conformance.html')));
test('long.html repeats the heads of its tables', () =>
  checks.repeatsHeads(browser, inFolder('long.html')));

test('certificate.html numbers its sheets and cuts no table that fits on one', () =>
  checks.numbersSheets(browser, inFolder('certificate.html'), 'EGL-2026-0042'));

for (const [name, scripts] of [['hostile.html', 1], ['hostile_certificate.html', 0],
  ['hostile_qa.html', 0], ['hostile_qa_history.html', 0]]) {
  test(`hostile text of ${name} is shown and not run`, async () => {
    const page = await checks.opened(browser, inFolder(name));
    const [title, found, text] = await page.evaluate(() =>
      [document.title, document.scripts.length, document.body.innerText]);
    assert.notEqual(title, 'run');
    assert.equal(found, scripts);
    assert.ok(text.includes('<script>document.title = \'run\'</script>'));
    assert.ok(text.includes('{{title}} {{{svg}}}'));
    assert.ok(!fs.existsSync(inFolder('trace')));
  });
}

for (const name of ['conformance.xml', 'hostile.xml']) {
  test(`${name} is well-formed, and its sums are right`, async () => {
    const page = await browser.newPage();
    const read = await page.evaluate((xml) => {
      const document = new DOMParser().parseFromString(xml, 'application/xml');
      const number = (element, key) => Number(element.getAttribute(key));
      const sum = (key) => [...document.querySelectorAll('testsuite')]
        .reduce((total, suite) => total + number(suite, key), 0);
      return { error: document.querySelector('parsererror')?.textContent ?? '',
        sums: ['tests', 'failures', 'errors', 'skipped'].map(sum),
        elements: ['testcase', 'failure', 'error', 'skipped']
          .map((element) => document.querySelectorAll(element).length),
        total: ['tests', 'failures', 'errors', 'skipped']
          .map((key) => number(document.documentElement, key)),
        device: document.querySelector('testsuites > properties > [name=device]')
          ?.getAttribute('value') };
    }, fs.readFileSync(inFolder(name), 'utf8'));
    assert.equal(read.error, '');
    assert.deepEqual(read.sums, read.elements);
    assert.deepEqual(read.total, read.elements);
    assert.ok(read.elements[0] > 0);
    if (name === 'hostile.xml') assert.ok(read.device.includes(']]> | a | {{title}}'));
  });
}
