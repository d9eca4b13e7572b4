/** Round numbers between `low` and `high`, about `count` of them: 1, 2 or 5 times a power of ten. */
export interface Ticks {
  values: number[];
  step: number;
}

export function round_ticks(low: number, high: number, count: number): Ticks {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return { values: [low], step: 0 };
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((m) => m * power >= rough) ?? 10);
  const values: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; ++k) {
    values.push(k === 0 ? 0 : k * step);
  }
  return { values, step };
}
