'use strict';
// A session with the glossmeter through jsmodbus, over TCP.
//
//   node jsmodbus_client.js HOST:PORT SERIAL_NUMBER SAMPLE TOLERANCE GLOSS...
//
// Requests that are not awaited stand in the queue of the library, which sends the next one as soon
// as it has the answer to the one before. It has no mask write and no read/write multiple.

const { once } = require('node:events');
const net = require('node:net');
const jsmodbus = require('jsmodbus');
const { main } = require('./session.js');

const TIMEOUT_MS = 10_000;

const socket = new net.Socket();
const device = new jsmodbus.client.TCP(socket, 1, TIMEOUT_MS);

const registers = ({ response }) => response.body.valuesAsArray;
const bits = ({ response }) => response.body.valuesAsArray.map((bit) => bit === 1);

const client = {
  async identification(code, id) {
    const { objects } = (await device.readDeviceIdentification(code, id)).response.body;
    return Object.fromEntries(objects.map((object) => [object.id, String(object.value)]));
  },
  readCoils: async (address, count) => bits(await device.readCoils(address, count)),
  readDiscreteInputs: async (address, count) => bits(await device.readDiscreteInputs(address, count)),
  readHoldingRegisters: async (address, count) =>
    registers(await device.readHoldingRegisters(address, count)),
  readInputRegisters: async (address, count) =>
    registers(await device.readInputRegisters(address, count)),
  writeCoil: (address, value) => device.writeSingleCoil(address, value),
  writeRegister: (address, value) => device.writeSingleRegister(address, value),
  writeCoils: (address, values) => device.writeMultipleCoils(address, values),
  writeRegisters: (address, values) => device.writeMultipleRegisters(address, values),
  exceptionOf: (error) => error.response?.body.code ?? error,
};

async function connect(host, port) {
  socket.connect({ host, port });
  await once(socket, 'connect');
  return client;
}

main(connect, () => socket.end());
