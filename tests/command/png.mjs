// PNG files as numbers, both ways: without interlacing, 8 or 16 bits a channel.
import { readFileSync } from 'node:fs';
import { deflateSync, inflateSync } from 'node:zlib';

const channelsOf = { 0: 1, 2: 3, 4: 2, 6: 4 };

/** { width, height, channels, bits, at(x, y): an array of channel values } */
export function readPng(file) {
  const png = readFileSync(file);
  const [width, height, bits, channels] =
    [png.readUInt32BE(16), png.readUInt32BE(20), png[24], channelsOf[png[25]]];
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT')
      parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  const raw = inflateSync(Buffer.concat(parts));
  const step = channels * bits / 8;
  const row = width * step;
  const bytes = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y)
    for (let i = 0; i < row; ++i) {
      const left = i >= step ? bytes[y * row + i - step] : 0;
      const up = y > 0 ? bytes[(y - 1) * row + i] : 0;
      const corner = i >= step && y > 0 ? bytes[(y - 1) * row + i - step] : 0;
      bytes[y * row + i] = raw[y * (row + 1) + 1 + i] +
        [0, left, up, (left + up) >> 1, paeth(left, up, corner)][raw[y * (row + 1)]];
    }
  const at = (x, y) => Array.from({ length: channels }, (_, k) =>
    bits === 8 ? bytes[y * row + x * step + k] : bytes.readUInt16BE(y * row + x * step + 2 * k));
  return { width, height, channels, bits, at };
}

function paeth(left, up, corner) {
  const guess = left + up - corner;
  const [dl, du, dc] = [left, up, corner].map((value) => Math.abs(guess - value));
  return dl <= du && dl <= dc ? left : du <= dc ? up : corner;
}

/** FileBytes of a gray PNG of 16 bits, of value(x, y) from 0 to 65535. */
export function grayPng(width, height, value) {
  const rows = Buffer.alloc((2 * width + 1) * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      rows.writeUInt16BE(value(x, y), y * (2 * width + 1) + 1 + 2 * x);
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 16, 0, 0, 0, 0]);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  const chunk = (type, content) => {
    const checked = Buffer.concat([Buffer.from(type, 'latin1'), content]);
    const [length, crc] = [Buffer.alloc(4), Buffer.alloc(4)];
    length.writeUInt32BE(content.length);
    crc.writeUInt32BE(crcOf(checked));
    return Buffer.concat([length, checked, crc]);
  };
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', header),
                        chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

function crcOf(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc >>> 1 ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}
