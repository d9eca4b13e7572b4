import type { ArrayRef, Report, Scene } from "./payload";

/** Thrown if the data in the page are inconsistent; the message is shown to the reader. */
export class DamagedPage extends Error {}

function text_of(id: string): string {
  return document.getElementById(id)?.textContent?.trim() ?? "";
}

export function read_report(): Report {
  const report = parse("report");
  if (typeof report !== "object" || report === null) throw new DamagedPage("its report is missing");
  return report as Report;
}

/** The scene, or null if the page has none. */
export function read_scene(): Scene | null {
  return parse("scene") as Scene | null;
}

function parse(id: string): unknown {
  try {
    return JSON.parse(text_of(id));
  } catch {
    throw new DamagedPage(`its ${id} is missing or cut off`);
  }
}

/** Unpacks the arrays of a scene and removes their text from the page to free its memory. */
export async function read_bytes(scene: Scene): Promise<ArrayBuffer> {
  const packed = bytes_of_base64(text_of("bytes"));
  document.getElementById("bytes")?.remove();
  if (packed.length === 0 && scene.bytes_length === 0) return new ArrayBuffer(0);
  if (typeof DecompressionStream === "undefined") {
    throw new Error("This browser is too old to unpack the mesh (it has no DecompressionStream).");
  }
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer().catch(() => {
    throw new DamagedPage("its mesh cannot be unpacked");
  });
  if (buffer.byteLength !== scene.bytes_length) {
    throw new DamagedPage(`its mesh has ${buffer.byteLength} bytes, not ${scene.bytes_length}`);
  }
  return buffer;
}

function bytes_of_base64(text: string): Uint8Array<ArrayBuffer> {
  let binary: string;
  try {
    binary = atob(text);
  } catch {
    throw new DamagedPage("its mesh is missing or cut off");
  }
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const array_types = { float32: Float32Array, uint32: Uint32Array, uint8: Uint8Array } as const;

/** A view of the array that `ref` describes; its type and length must be `type` and `length`. */
export function array_of<T extends ArrayRef["type"]>(
  buffer: ArrayBuffer,
  ref: ArrayRef,
  type: T,
  length: number,
): InstanceType<(typeof array_types)[T]> {
  const constructor = array_types[type];
  const end = ref.offset + ref.length * constructor.BYTES_PER_ELEMENT;
  if (ref.type !== type || ref.length !== length || !(end <= buffer.byteLength)) {
    throw new DamagedPage("an array of its mesh has the wrong size");
  }
  return new constructor(buffer, ref.offset, length) as InstanceType<(typeof array_types)[T]>;
}
