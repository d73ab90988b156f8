// Reads an MCAP file with the reference library and prints what is in it. Not part of scripts/test: it needs npm.
//   npm install --prefix /tmp/mcap @mcap/core && NODE_PATH=/tmp/mcap/node_modules node test/bus/log/verify_mcap.mjs FILE
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
const require = createRequire(`${process.env.NODE_PATH}/`);
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");

const bytes = readFileSync(process.argv[2]);
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(size)),
};
const reader = await McapIndexedReader.Initialize({ readable });
const counts = new Map();
let last = 0n;
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = JSON.parse(new TextDecoder().decode(reader.schemasById.get(channel.schemaId).data));
  const value = JSON.parse(new TextDecoder().decode(message.data));
  for (const key of schema.required ?? []) if (!(key in value)) throw new Error(`${channel.topic}: no ${key}`);
  if (message.logTime < last) throw new Error("not in order of time");
  last = message.logTime;
  counts.set(channel.topic, (counts.get(channel.topic) ?? 0) + 1);
}
const stream = new McapStreamReader({ validateCrcs: true });
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) streamed += record.type === "Message" ? 1 : 0;
const total = [...counts.values()].reduce((sum, n) => sum + n, 0);
if (total !== streamed || BigInt(total) !== reader.statistics.messageCount) throw new Error("counts differ");
console.log(`${total} messages, ${reader.chunkIndexes.length} chunks, ${reader.schemasById.size} schemas`);
for (const [topic, n] of [...counts].sort()) console.log(`${topic} ${n}`);
