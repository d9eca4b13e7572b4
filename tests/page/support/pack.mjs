import { gzipSync } from "node:zlib";

/** Collects the arrays of a scene, as the program writes them. */
export class Packer {
  #parts = [];
  length = 0;

  /** Adds numbers and returns the reference to them. */
  add(type, numbers) {
    const types = { float32: Float32Array, uint32: Uint32Array, uint8: Uint8Array };
    const array = types[type].from(numbers);
    const padded = Buffer.alloc(Math.ceil(array.byteLength / 4) * 4);
    Buffer.from(array.buffer).copy(padded);
    const ref = { type, offset: this.length, length: array.length };
    this.#parts.push(padded);
    this.length += padded.length;
    return ref;
  }

  base64() {
    return gzipSync(Buffer.concat(this.#parts)).toString("base64");
  }
}

/** The page with its placeholders replaced: `scene` and `bytes` can be left out. */
export function fill_template(template, { report, scene = null, bytes = "" }) {
  const json = (value) => JSON.stringify(value).replaceAll("<", "\\u003c");
  const replacements = {
    "@IBMFAIR_REPORT@": json(report),
    "@IBMFAIR_SCENE@": json(scene),
    "@IBMFAIR_BYTES@": bytes,
  };
  let page = template;
  for (const [placeholder, text] of Object.entries(replacements)) {
    if (page.split(placeholder).length !== 2) throw new Error(`${placeholder} is not there once`);
    page = page.replace(placeholder, () => text);
  }
  return page;
}
