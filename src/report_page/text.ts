/** Formats numbers and names in the same way on the whole page. */

/** Characters that could mislead readers: control characters and changes of writing direction. */
// eslint-disable-next-line no-control-regex
const deceptive = /[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;

/** A text from a file, with its unprintable characters escaped as on the terminal. */
export function printable(text: string): string {
  return text.replace(deceptive, (c) => {
    const code = c.charCodeAt(0);
    if (c === "\n") return "\\n";
    if (c === "\t") return "\\t";
    return code < 256
      ? `\\x${code.toString(16).padStart(2, "0")}`
      : `\\u${code.toString(16).padStart(4, "0")}`;
  });
}

const missing = "\u2013";

/** Integers with thin spaces between thousands, other numbers to `digits` digits, else a dash. */
export function number_text(value: unknown, digits = 4): string {
  if (typeof value !== "number" || !Number.isFinite(value)) return missing;
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return count_text(value);
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e6) return exponential(value, digits);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return signed(value, grouped(without_zeros(size.toFixed(decimals))));
}

/** A short label of an axis, with a power of ten for large numbers. */
export function tick_text(value: number): string {
  return Math.abs(value) >= 1e5 ? exponential(value, 3) : number_text(value, 3);
}

export function count_text(value: number): string {
  return signed(value, grouped(Math.abs(value).toFixed(0)));
}

function grouped(digits: string): string {
  const [whole = "", decimals] = digits.split(".");
  const parted = whole.replace(/\d(?=(\d{3})+$)/g, "$&\u202f");
  return decimals === undefined ? parted : `${parted}.${decimals}`;
}

function exponential(value: number, digits: number): string {
  const [mantissa = "", exponent = ""] = Math.abs(value)
    .toExponential(digits - 1)
    .split("e");
  const power = raised(String(Number(exponent)));
  const short = without_zeros(mantissa);
  return signed(value, short === "1" ? `10${power}` : `${short}\u00b710${power}`);
}

function raised(digits: string): string {
  return [...digits].map((c) => superscripts[c] ?? c).join("");
}

function without_zeros(digits: string): string {
  return digits.includes(".") ? digits.replace(/\.?0+$/, "") : digits;
}

const superscripts: Record<string, string> = Object.fromEntries(
  [..."-0123456789"].map((c, i) => [c, [..."⁻⁰¹²³⁴⁵⁶⁷⁸⁹"][i] ?? ""]),
);

function signed(value: number, digits: string): string {
  return value < 0 ? `\u2212${digits}` : digits;
}

export function seconds_text(value: unknown): string {
  if (typeof value !== "number" || !Number.isFinite(value)) return missing;
  if (value >= 100) return `${count_text(Math.round(value))} s`;
  if (value >= 0.1) return `${value.toFixed(value >= 10 ? 1 : 2)} s`;
  if (value >= 0.0001) return `${(value * 1000).toFixed(value >= 0.01 ? 0 : 1)} ms`;
  return value === 0 ? "0 s" : "< 0.1 ms";
}

/** The change from `before` to `after` in per cent; empty if no ratio can be formed. */
export function change_text(before: unknown, after: unknown): string {
  if (typeof before !== "number" || typeof after !== "number") return "";
  if (before === after) return "=";
  if (before === 0 || !Number.isFinite(after / before)) return "";
  const percent = 100 * (after / before - 1);
  const size = Math.abs(percent);
  if (size >= 1000) return `\u00d7 ${number_text(after / before, 3)}`;
  if (size < 1e-6) return "\u2248";
  const text = size < 0.01 ? size.toFixed(6).replace(/([1-9]).*/, "$1") : size.toPrecision(3);
  return `${percent < 0 ? "\u2212" : "+"}${text} %`;
}

/** "smallest_angle_degrees" as "Smallest angle degrees". */
export function title_of(key: string): string {
  const words = key.replace(/[_.]/g, " ").trim();
  return printable(words.charAt(0).toUpperCase() + words.slice(1));
}

/** Any value of the report as one line of text. */
export function value_text(value: unknown): string {
  if (value === null || value === undefined) return missing;
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value === "number") return number_text(value, 6);
  if (typeof value === "string") return value === "" ? missing : printable(value);
  if (Array.isArray(value))
    return value.length === 0 ? "none" : value.map((v) => value_text(v)).join(", ");
  return printable(JSON.stringify(value));
}

/** "1/length^2" with its exponents raised. */
export function unit_text(unit: string): string {
  return printable(unit).replace(/\^(-?\d+)/g, (_, exponent: string) => raised(exponent));
}

/** The last part of a path. */
export function file_name(path: string): string {
  return printable(path.replace(/^.*[\\/](?=[^\\/])/, ""));
}
