'use strict';
// A session with the glossmeter through modbus-serial, over TCP.
//
//   node modbus_serial_client.js HOST:PORT SERIAL_NUMBER SAMPLE TOLERANCE GLOSS...
//
// Requests that are not awaited go out at once, whether or not answers are under way.

const ModbusSerial = require('modbus-serial');
const { main } = require('./session.js');

const TIMEOUT_MS = 10_000;

const device = new ModbusSerial();

const client = {
  identification: async (code, id) => (await device.readDeviceIdentification(code, id)).data,
  readCoils: async (address, count) => (await device.readCoils(address, count)).data,
  readDiscreteInputs: async (address, count) =>
    (await device.readDiscreteInputs(address, count)).data,
  readHoldingRegisters: async (address, count) =>
    (await device.readHoldingRegisters(address, count)).data,
  readInputRegisters: async (address, count) =>
    (await device.readInputRegisters(address, count)).data,
  writeCoil: (address, value) => device.writeCoil(address, value),
  writeRegister: (address, value) => device.writeRegister(address, value),
  writeCoils: (address, values) => device.writeCoils(address, values),
  writeRegisters: (address, values) => device.writeRegisters(address, values),
  maskWriteRegister: (address, and, or) => device.maskWriteRegister(address, and, or),
  readWriteRegisters: async (readAddress, count, writeAddress, values) =>
    (await device.readWriteRegisters(readAddress, count, writeAddress, values.length, values)).data,
  exceptionOf: (error) => error.modbusCode ?? error,
};

async function connect(host, port) {
  await device.connectTCP(host, { port });
  device.setID(1);
  device.setTimeout(TIMEOUT_MS);
  return client;
}

main(connect, () => device.close());
