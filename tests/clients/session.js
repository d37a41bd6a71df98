'use strict';
// A session with the glossmeter, the same for every JavaScript client.
//
// A client is an object with the methods
//   identification(readCode, objectId) -> objects of function code 43/14, texts by number
//   readCoils, readDiscreteInputs, readHoldingRegisters, readInputRegisters (address, count) -> array
//   writeCoil, writeRegister (address, value); writeCoils, writeRegisters (address, values)
//   exceptionOf(error) -> code of the exception
// and, if the library can, maskWriteRegister(address, and, or) and readWriteRegisters(readAddress,
// readCount, writeAddress, values) -> array. All return promises.

const assert = require('node:assert/strict');
const { setTimeout: pause } = require('node:timers/promises');

const DEADLINE_MS = 60_000;
const POLL_INTERVAL_MS = 5;

const exceptions = { illegalAddress: 2, illegalValue: 3, busy: 6 };
const commands = { measure: 1, calibrate: 2 };
const commandDone = 2;
const covers = { tile: 1, sample: 3 };
const modes = { single: 0, continuous: 2 };
const manyRequests = 32;

const float32 = Math.fround;

/** Bytes of registers, high byte first. */
function bytesOf(registers) {
  const bytes = Buffer.alloc(2 * registers.length);
  registers.forEach((value, i) => bytes.writeUInt16BE(value, 2 * i));
  return bytes;
}

const text = (registers) => bytesOf(registers).toString('ascii').replace(/\0+$/, '');

/** @param from  index of the first register. */
const floatAt = (registers, from) => bytesOf(registers).readFloatBE(2 * from);

async function waitFor(what, condition) {
  const deadline = Date.now() + DEADLINE_MS;
  while (!(await condition())) {
    assert.ok(Date.now() < deadline, `waited too long for ${what}`);
    await pause(POLL_INTERVAL_MS);
  }
}

/** Starts a command and waits until it is done. */
async function carryOut(client, what, start) {
  const [sequence] = await client.readInputRegisters(7, 1);
  await start();
  await waitFor(what, async () => (await client.readInputRegisters(9, 1))[0] >= commandDone);
  const [newSequence, , state, error] = await client.readInputRegisters(7, 4);
  assert.deepEqual([newSequence, state, error], [(sequence + 1) % 65536, commandDone, 0], what);
}

async function refusal(client, request) {
  try {
    await request();
  } catch (error) {
    return client.exceptionOf(error);
  }
  return 'none';
}

async function identify(client, serialNumber) {
  const basic = await client.identification(1, 0);
  assert.deepEqual([basic[0], basic[1]], ['gonio', 'Triangle Gloss'], 'identification');
  assert.equal((await client.identification(4, 0x80))[0x80], serialNumber, 'serial number');
  assert.equal(text(await client.readInputRegisters(400, 8)), serialNumber, 'its registers');
  assert.equal(text(await client.readInputRegisters(424, 16)), 'Triangle Gloss', 'model');
}

async function tryTestRegisters(client) {
  const registers = await client.readInputRegisters(300, 14);
  const bytes = bytesOf(registers);
  assert.equal(floatAt(registers, 0), float32(-123.45), 'float');
  assert.equal(floatAt([registers[3], registers[2]], 0), float32(-123.45), 'low word first');
  assert.deepEqual(
    [bytes.readInt16BE(8), bytes.readUInt16BE(10), bytes.readInt32BE(12), bytes.readUInt32BE(16)],
    [-12345, 54321, -123456789, 0x12345678], 'integers');
  assert.equal(text(registers.slice(10)), '-123.45', 'text');
}

async function calibrate(client) {
  await waitFor('the lamp', async () => !(await client.readDiscreteInputs(3007, 1))[0]);
  await client.writeRegister(1100, covers.tile);
  assert.equal((await client.readDiscreteInputs(3006, 1))[0], true, 'lies on the tile');
  await carryOut(client, 'calibration', () => client.writeRegister(1000, commands.calibrate));
  assert.deepEqual(await client.readInputRegisters(216, 3), [1, 1, 1], 'calibrated');
}

/** Floats and integers of one snapshot, against each other and against the computation. */
async function measure(client, sample, toleranceGu, expectedGu) {
  await client.writeRegisters(1100, [covers.sample, sample]);
  const count = bytesOf(await client.readInputRegisters(5, 2)).readUInt32BE();
  await carryOut(client, 'measurement', () => client.writeCoil(2000, true));
  const snapshot = await client.readInputRegisters(0, 114);
  assert.equal(bytesOf(snapshot).readUInt32BE(10), count + 1, 'count of readings');
  assert.deepEqual(snapshot.slice(27, 30), [1, 1, 1], 'states of the readings');
  for (let channel = 0; channel < expectedGu.length; ++channel) {
    const gloss = floatAt(snapshot, 18 + 2 * channel);
    const computed = expectedGu[channel];
    assert.ok(Math.abs(gloss - float32(computed)) <= toleranceGu,
      `gloss: expected ${computed} within ${toleranceGu}, found ${gloss}`);
    const tenths = bytesOf(snapshot).readInt16BE(2 * (24 + channel));
    // Half a step, and rounding of float32.
    assert.ok(Math.abs(tenths - 10 * gloss) < 0.5001, `${tenths} tenths of a gloss of ${gloss}`);
    const [low, high] = snapshot.slice(92 + 2 * channel);
    assert.equal(floatAt([high, low], 0), gloss, 'gloss with the low word first');
  }
  assert.deepEqual(await client.readHoldingRegisters(18, 6), snapshot.slice(18, 24),
    'gloss by function code 3');
}

/** With mask write, and with a write and a read in one request. */
async function changeSettings(client) {
  assert.deepEqual(await client.readHoldingRegisters(1006, 1), [0b111], 'measured channels');
  await client.maskWriteRegister(1006, 0xFFFD, 0);
  assert.deepEqual(await client.readWriteRegisters(1006, 1, 1003, [7]), [0b101], 'mask write');
  assert.deepEqual(await client.readHoldingRegisters(1003, 1), [7], 'number of readings');
  await client.writeRegister(1006, 0b111);
}

/** Each for its reason; the instrument stays as it is. */
async function provokeExceptions(client) {
  const expect = async (code, what, request) =>
    assert.equal(await refusal(client, request), code, `exception: ${what}`);
  await expect(exceptions.illegalAddress, 'a hole', () => client.readInputRegisters(900, 1));
  await expect(exceptions.illegalAddress, 'a constant', () => client.writeRegister(1102, 1));
  await expect(exceptions.illegalValue, 'no such mode', () => client.writeRegister(1002, 99));
  await client.writeRegister(1002, modes.continuous);
  await client.writeRegister(1000, commands.measure);
  assert.equal((await client.readDiscreteInputs(3001, 1))[0], true, 'busy');
  assert.deepEqual((await client.readCoils(2000, 5)).slice(0, 5),
    [true, false, false, false, false], 'coil of what runs');
  await expect(exceptions.busy, 'busy', () => client.writeRegister(1000, commands.measure));
  await client.writeCoils(2003, [true, true]); // stop, acknowledge alarms
  assert.equal((await client.readDiscreteInputs(3001, 1))[0], false, 'busy after stop');
  await client.writeRegister(1002, modes.single);
}

/** Many requests at once: every answer belongs to its request, and they come in order. */
async function askManyAtOnce(client) {
  const addresses = Array.from({ length: manyRequests }, (_, i) => 300 + (i % 14));
  const expected = await client.readInputRegisters(300, 14);
  const order = [];
  const answers = await Promise.all(addresses.map(async (address, i) => {
    // One in eight is refused; the others do not notice.
    const isHole = i % 8 === 5;
    const request = () => client.readInputRegisters(isHole ? 900 : address, 1);
    const answer = isHole ? [await refusal(client, request)] : await request();
    order.push(i);
    return answer[0];
  }));
  addresses.forEach((address, i) =>
    assert.equal(answers[i], i % 8 === 5 ? exceptions.illegalAddress : expected[address - 300],
      `answer ${i} of many`));
  // What is refused takes a step longer to be noticed here.
  const good = order.filter((i) => i % 8 !== 5);
  assert.deepEqual(good, [...good].sort((a, b) => a - b), 'order of the answers');
}

/** The whole session; the arguments are those of the command line. */
async function session(client, [serialNumber, sample, toleranceGu, ...expectedGu]) {
  await identify(client, serialNumber);
  await tryTestRegisters(client);
  await calibrate(client);
  await measure(client, Number(sample), Number(toleranceGu), expectedGu.map(Number));
  if (client.maskWriteRegister) {
    await changeSettings(client);
  }
  await provokeExceptions(client);
  await askManyAtOnce(client);
}

/** Runs the session. @param connect  (host, port) -> client; @param close  ends its connection. */
async function main(connect, close) {
  const [place, ...rest] = process.argv.slice(2);
  const [host, port] = place.split(':');
  process.exitCode = 1; // also if nothing is left to wait for before the end is reached
  try {
    await session(await connect(host, Number(port)), rest);
    process.exitCode = 0;
  } catch (error) {
    console.error(error);
  }
  close();
}

module.exports = { main };
