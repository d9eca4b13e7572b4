import { interpolateViridis } from "d3-scale-chromatic";

/**
 * Perceptually uniform colour maps that do not require distinguishing red from green: viridis, in
 * which larger values are brighter, and for signed values Moreland's cool to warm, whose lightness
 * decreases equally on both sides of its grey middle.
 *
 * K. Moreland, Diverging color maps for scientific visualization, ISVC 2009.
 */
export interface ColourMap {
  name: string; // read out by screen readers
  colours: Uint8Array; // RGBA, 256 entries
}

export const entries = 256;

type Triple = [number, number, number];

/** Moreland's polar form of CIELAB: magnitude, saturation angle, hue angle. */
const cool: Triple = [80, 1.08, -1.1];
const middle: Triple = [88, 0, 0];
const warm: Triple = [80, 1.08, 0.5];

/** The hue of an end, shifted for the unsaturated middle so that the map stays uniform. */
function middle_hue(end: Triple): number {
  const [M, s, h] = end;
  const turn = (s * Math.sqrt(Math.max(middle[0] ** 2 - M ** 2, 0))) / (M * Math.sin(s));
  return h > -Math.PI / 3 ? h + turn : h - turn;
}

function cool_to_warm(t: number): Triple {
  const end = t < 0.5 ? cool : warm;
  const share = Math.abs(2 * t - 1); // 1 at the end, 0 in the middle
  const hue = middle_hue(end);
  return srgb_of_msh([
    middle[0] + share * (end[0] - middle[0]),
    share * end[1],
    hue + share * (end[2] - hue),
  ]);
}

function srgb_of_msh([M, s, h]: Triple): Triple {
  const L = M * Math.cos(s);
  const a = M * Math.sin(s) * Math.cos(h);
  const b = M * Math.sin(s) * Math.sin(h);
  const y = (L + 16) / 116;
  const linear = (f: number) => (f > 6 / 29 ? f ** 3 : 3 * (6 / 29) ** 2 * (f - 4 / 29));
  const X = 0.9505 * linear(y + a / 500);
  const Y = linear(y);
  const Z = 1.089 * linear(y - b / 200);
  const gamma = (c: number) =>
    255 * Math.min(1, Math.max(0, c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  return [
    gamma(3.2406 * X - 1.5372 * Y - 0.4986 * Z),
    gamma(-0.9689 * X + 1.8758 * Y + 0.0415 * Z),
    gamma(0.0557 * X - 0.204 * Y + 1.057 * Z),
  ];
}

function viridis(t: number): Triple {
  const hex = interpolateViridis(t);
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)) as Triple;
}

function tabulate(name: string, colour_of: (t: number) => Triple): ColourMap {
  const colours = new Uint8Array(4 * entries);
  for (let i = 0; i < entries; ++i) {
    colours.set([...colour_of(i / (entries - 1)).map(Math.round), 255], 4 * i);
  }
  return { name, colours };
}

export const sequential = tabulate("dark violet to green to yellow", viridis);
export const diverging = tabulate("blue to grey to red", cool_to_warm);

export function css_gradient(map: ColourMap): string {
  const stops: string[] = [];
  for (let i = 0; i < entries; i += 15) {
    stops.push(`rgb(${map.colours.slice(4 * i, 4 * i + 3).join(",")})`);
  }
  return `linear-gradient(to right, ${stops.join(",")})`;
}
