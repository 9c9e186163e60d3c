// Reads STATUS and claims a cell by modbus-serial. node modbus_serial.cjs MODULE PORT FRAME: FRAME is COMMAND in
// hexadecimal digits. Prints the registers of STATUS before and after, and the exception of a partial write, as JSON.
const ModbusRTU = require(process.argv[2]);

async function main() {
    const client = new ModbusRTU();
    await client.connectTCP("127.0.0.1", { port: Number(process.argv[3]) });
    client.setID(1);
    client.setTimeout(5000);
    const frame = process.argv[4].match(/.{4}/g).map((digits) => parseInt(digits, 16));
    const before = (await client.readInputRegisters(0, 100)).data;
    const partial = await client.writeRegisters(0, frame.slice(0, 59)).then(() => 0, (error) => error.modbusCode);
    await client.writeRegisters(0, frame);
    const after = (await client.readInputRegisters(0, 100)).data;
    console.log(JSON.stringify({ before, partial, after }));
    client.close();
}
main().then(() => process.exit(0), (error) => { console.error(error); process.exit(1); });
