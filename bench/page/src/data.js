// What the program put into the page (bench/page.cpp), and how its numbers are unpacked.

export const report = JSON.parse(document.getElementById('data').textContent);

export const methods_of = (scene) => [...new Set(scene.runs.map((run) => run.method))];

// What is said of a method's runs on both arms: `a / b`, or one where they are alike.
export const of_both = (texts) => [...new Set(texts)].join(' / ');

async function inflate(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A pack holds matrices: each column quantised, its differences zigzag-coded, their bytes in four planes.
export class Pack {
  static async open(base64) {
    return new Pack(await inflate(base64));
  }

  constructor(bytes) {
    this.bytes = bytes;
  }

  // The columns of a matrix {at, rows, columns, zero, step}, each a Float64Array; zero and step are one number
  // for all columns or one for each.
  columns({ at, rows, columns, zero, step }) {
    const plane = rows * columns;
    const [b0, b1, b2, b3] = [0, 1, 2, 3].map((i) => this.bytes.subarray(at + i * plane));
    return Array.from({ length: columns }, (_, c) => {
      const values = new Float64Array(rows);
      const [z, s] = [zero, step].map((x) => (Array.isArray(x) ? x[c] : x));
      for (let i = 0, k = c * rows, sum = 0; i < rows; ++i, ++k) {
        const code = (b0[k] | (b1[k] << 8) | (b2[k] << 16) | (b3[k] << 24)) >>> 0;
        sum += code & 1 ? -((code >>> 1) + 1) : code >>> 1;
        values[i] = z + s * sum;
      }
      return values;
    });
  }
}

// The last row whose time is not after `time`.
export function row_at(times, time) {
  let low = 0;
  for (let high = times.length; high - low > 1; ) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}
