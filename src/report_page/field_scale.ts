import type { Field } from "./payload";
import { round_ticks } from "./ticks";

/** Maps values of a field to shares of its range: 0 and 1 are the ends of the colour map. */
export interface FieldScale {
  is_log: boolean;
  share: (value: number) => number;
  ticks: (count: number) => number[];
  /** The first contour line and the distance to the next, as shares. */
  contours: { first: number; step: number };
}

const least_for_log = 1e3;

/** Linear in the value, or in its logarithm if the range is positive and spans 1 : 1000 or more. */
export function scale_of(field: Field): FieldScale {
  const [low, high] = [field.range[0] ?? 0, field.range[1] ?? 0];
  const is_log = !field.diverging && low > 0 && high / low >= least_for_log;
  const [from, to] = is_log ? [Math.log10(low), Math.log10(high)] : [low, high];
  const share_of_even = (x: number) => (to > from ? (x - from) / (to - from) : 0.5);
  const even = is_log ? { values: decades(from, to), step: 1 } : round_ticks(from, to, 8);
  return {
    is_log,
    share: (value) => share_of_even(is_log ? Math.log10(value) : value),
    ticks: (count) => {
      if (!is_log) return round_ticks(from, to, count).values;
      const apart = Math.ceil(even.values.length / count);
      return even.values.filter((_, i) => i % apart === 0).map((power) => 10 ** power);
    },
    contours: {
      first: share_of_even(even.values[0] ?? from),
      step: to > from ? even.step / (to - from) : 10,
    },
  };
}

function decades(from: number, to: number): number[] {
  const powers: number[] = [];
  for (let power = Math.ceil(from); power <= to; ++power) powers.push(power);
  return powers;
}
