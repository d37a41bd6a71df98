'use strict';
// What holds for every page of a report. Each check opens the page anew in a tab of its own, and
// throws if it does not hold.

const assert = require('node:assert/strict');
const { execFileSync } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

const MM_PER_INCH = 25.4;
const PX_PER_INCH = 96;
const A4_TEXT_WIDTH_PX = Math.floor((210 - 2 * 15) / MM_PER_INCH * PX_PER_INCH);
const DESKTOP_WIDTH_PX = 1200;
const SCREEN_HEIGHT_PX = 900;

async function opened(browser, file, prepare = async () => {}) {
  const page = await browser.newPage();
  await prepare(page);
  await page.open(file);
  return page;
}

const withWidth = (width) => (page) => page.call('Emulation.setDeviceMetricsOverride',
  { width, height: SCREEN_HEIGHT_PX, deviceScaleFactor: 1, mobile: false });

async function onPaper(page) {
  await withWidth(A4_TEXT_WIDTH_PX)(page);
  await page.call('Emulation.setEmulatedMedia', { media: 'print' });
}

/** No error, no warning and no other word in the console; nothing asked of anybody. */
async function isQuiet(browser, file) {
  const page = await opened(browser, file);
  await page.evaluate(() => document.fonts.ready.then(() => true));
  assert.deepEqual(page.complaints, []);
  const others = page.requests.filter((url) => !url.startsWith('data:'));
  assert.deepEqual(others, [`file://${path.resolve(file)}`]);
}

/** As many charts as there should be, each with curves or outlines that one sees. */
async function drawsCharts(browser, file, expected) {
  const page = await opened(browser, file, withWidth(DESKTOP_WIDTH_PX));
  const charts = await page.evaluate(() => {
    const isSeen = (curve) => {
      const size = curve.getBoundingClientRect();
      return curve.getTotalLength() > 0 && size.width + size.height > 0;
    };
    return Array.from(document.querySelectorAll('figure svg'), (svg) => ({
      width: svg.getBoundingClientRect().width,
      height: svg.getBoundingClientRect().height,
      curves: [...svg.querySelectorAll('[id*="gnuplot_plot_"] path')].filter(isSeen).length,
      pictures: Array.from(svg.querySelectorAll('image'), (image) => image.getBBox().width),
    }));
  });
  assert.equal(charts.length, expected);
  charts.forEach((chart) => {
    assert.ok(chart.width > 300 && chart.height > 100, JSON.stringify(chart));
    assert.ok(chart.curves > 0, JSON.stringify(chart));
    assert.ok(chart.pictures.every((width) => width > 0), JSON.stringify(chart));
  });
}

/** Every id once, every link to an end that is there. */
async function leadsSomewhere(browser, file) {
  const page = await opened(browser, file);
  const [twice, lost] = await page.evaluate(() => {
    const ids = [...document.querySelectorAll('[id]')].map((element) => element.id);
    const ends = [...document.querySelectorAll('[href], use')].map((element) =>
      element.getAttribute('href') ?? element.getAttribute('xlink:href'));
    const isLost = (end) => !document.getElementById(decodeURIComponent(end.slice(1)));
    return [ids.filter((id, i) => ids.indexOf(id) !== i), ends.filter(isLost)];
  });
  assert.deepEqual(twice, []);
  assert.deepEqual(lost, []);
}

/** What a reader without eyes or without colours needs. */
async function isAccessible(browser, file) {
  const page = await opened(browser, file);
  const faults = await page.evaluate(() => {
    const all = (selector) => [...document.querySelectorAll(selector)];
    const found = (what, elements) => elements.map((element) =>
      `${what}: ${element.outerHTML.slice(0, 80)}`);
    return [
      ...found('no scope', all('th:not([scope])')),
      ...found('no caption', all('table').filter((table) => !table.caption)),
      ...found('no label', all('input, select').filter((control) => control.labels.length === 0)),
      ...found('no words', all('[role=img]').filter((image) => !image.ariaLabel)),
      ...found('not in an image', all('svg').filter((svg) => !svg.closest('[role=img]'))),
      ...found('no name', all('.verdict').filter((mark) => !/[a-z]{4}/.test(mark.textContent))),
      ...found('no underline', all('a').filter((link) =>
        !getComputedStyle(link).textDecorationLine.includes('underline'))),
      ...(document.documentElement.lang ? [] : ['no language']),
      ...(document.title ? [] : ['no title']),
    ];
  });
  assert.deepEqual(faults, []);
}

/** On paper of A4 nothing is wider than the paper, no row is cut and no filter is there. */
async function fitsOnPaper(browser, file) {
  const page = await opened(browser, file, onPaper);
  const [faults, width, room] = await page.evaluate(() => {
    const edge = document.documentElement.clientWidth;
    const isCut = (element) => element.scrollWidth > element.clientWidth + 1 ||
      element.getBoundingClientRect().right > edge + 1;
    const wide = [...document.querySelectorAll('table, .wide, figure, dl, p, li, h1, h2, h3')];
    const style = (element) => getComputedStyle(element);
    const text = (what) => (element) => `${what}: ${element.outerHTML.slice(0, 100)}`;
    const all = (selector) => [...document.querySelectorAll(selector)];
    return [[
      ...wide.filter(isCut).map(text('too wide')),
      ...all('tr').filter((row) => style(row).breakInside !== 'avoid').map(text('may be cut')),
      ...all('thead').filter((head) => style(head).display !== 'table-header-group')
        .map(text('not repeated')),
      ...all('form').filter((form) => style(form).display !== 'none').map(text('printed')),
    ], document.documentElement.scrollWidth, edge];
  });
  assert.deepEqual(faults, []);
  assert.ok(width <= room, `${width} px on ${room} px`);
}

/** The text of each sheet that is printed. */
async function printedSheets(page) {
  const { data } = await page.call('Page.printToPDF', { preferCSSPageSize: true });
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'gonio_print_'));
  try {
    const pdf = path.join(folder, 'page.pdf');
    fs.writeFileSync(pdf, Buffer.from(data, 'base64'));
    return execFileSync('pdftotext', [pdf, '-'], { encoding: 'utf8' }).split('\f');
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}

/** A long table has its head on every sheet that it goes on to. */
async function repeatsHeads(browser, file) {
  const sheets = await printedSheets(await opened(browser, file));
  const sheetWith = (text) => sheets.findIndex((sheet) => sheet.includes(text));
  const expectHead = (head, caption, next) => {
    const [first, last] = [sheetWith(caption), sheetWith(next)];
    assert.ok(first >= 0 && last - first >= 3, `${caption}: from sheet ${first} to ${last}`);
    sheets.slice(first, last).forEach((sheet, i) =>
      assert.ok(sheet.includes(head), `${head}: not on sheet ${first + i}`));
  };
  expectHead('Requirement and limit', 'All clauses, with and without', 'What the receptors see');
  expectHead('Leads to', 'All cases: what was tried', 'Evidence: C2 two or more');
}

/** Each sheet of a certificate says which one it is, of how many, and of which certificate; a table
 * that fits on one sheet is not cut, so its head stands there once. */
async function numbersSheets(browser, file, number) {
  const printed = await printedSheets(await opened(browser, file));
  const sheets = printed.filter((sheet) => sheet.trim()).map((sheet) => sheet.replace(/\s+/g, ' '));
  assert.ok(sheets.length > 3);
  sheets.forEach((sheet, i) => {
    assert.ok(sheet.includes(`page ${i + 1} of ${sheets.length}`), `sheet ${i + 1}: no number`);
    assert.ok(sheet.includes(`Calibration certificate ${number}, of`), `sheet ${i + 1}: no name`);
  });
  const count = (text) => sheets.join(' ').split(text).length - 1;
  for (const [caption, head] of [['Readings before and after adjustment', 'U by Monte Carlo'],
    ['Uncertainty budget at', 'Sensitivity']]) {
    assert.ok(count(caption) > 1, caption);
    assert.equal(count(head), count(caption), `${caption}: cut`);
  }
}

/** In the page: the verdicts of the rows of a kind that are seen. */
function seenVerdicts(kind) {
  return [...document.querySelectorAll(`tr[data-kind=${kind}]`)]
    .filter((row) => row.getClientRects().length > 0)
    .map((row) => row.dataset.verdict);
}

/** In the page: sets a control as a user does. */
function choose(name, value) {
  const control = document.querySelector(`#filter [name=${name}]`);
  control.value = value;
  control.dispatchEvent(new Event('input', { bubbles: true }));
}

/** Verdict, level and words hide rows; `Show all` brings them back. */
async function filters(browser, file) {
  const page = await opened(browser, file);
  const clauses = () => page.evaluate(seenVerdicts, 'clause');
  const all = await clauses();
  assert.ok(all.length > 2);

  await page.evaluate(choose, 'verdict', 'fail');
  assert.deepEqual(await clauses(), all.filter((verdict) => verdict === 'fail'));
  assert.ok((await page.evaluate(seenVerdicts, 'case')).every((verdict) => verdict === 'fail'));
  await page.evaluate(choose, 'words', 'INCIDENCE angle');
  assert.equal((await clauses()).length, 1);
  assert.match(await page.evaluate(() => document.getElementById('filter-count').textContent),
    /^1 of \d+ clauses/);
  await page.evaluate(choose, 'words', 'no such words');
  assert.equal((await clauses()).length, 0);

  await page.evaluate(() => new Promise((resolve) => {
    document.querySelector('#filter button').click();
    setTimeout(() => setTimeout(resolve));
  }));
  assert.deepEqual(await clauses(), all);
  await page.evaluate(choose, 'level', 'should');
  assert.deepEqual(await clauses(), ['skipped']);

  const isShown = await page.evaluate(() => {
    const hidden = document.querySelector('tr[data-kind=case][hidden]');
    document.querySelector(`a[href="#${hidden.id}"]`).click();
    return hidden.getClientRects().length > 0;
  });
  assert.ok(isShown, 'a link leads to a row that is hidden');

  await page.evaluate(choose, 'level', 'should');
  // A filed copy is whole, whatever the reader looked for before printing it.
  await page.call('Emulation.setEmulatedMedia', { media: 'print' });
  assert.deepEqual(await clauses(), all);
}

/** Without scripts all rows are there, and no control that would do nothing. */
async function worksWithoutScripts(browser, file) {
  const page = await opened(browser, file, (tab) =>
    tab.call('Emulation.setScriptExecutionDisabled', { value: true }));
  const [rows, seen, controls] = await page.evaluate(() => {
    const isSeen = (element) => element.getClientRects().length > 0;
    const all = [...document.querySelectorAll('tbody tr')];
    return [all.length, all.filter(isSeen).length,
      [...document.querySelectorAll('form, button')].filter(isSeen).length];
  });
  assert.ok(rows > 0);
  assert.equal(seen, rows);
  assert.equal(controls, 0);
}

module.exports = { drawsCharts, filters, fitsOnPaper, isAccessible, isQuiet, leadsSomewhere,
  numbersSheets, opened, repeatsHeads, worksWithoutScripts };
