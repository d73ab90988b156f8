// One number over time.

const MOST_S = 600, MOST_SAMPLES = 20000;

export interface Sample { t: number; v: number }  // s, the number

export class Series {
  private samples: Sample[] = [];

  constructor(readonly channel: string, readonly path: string) {}

  get name(): string {
    return `${this.channel} ${this.path}`;
  }

  add(t: number, v: number): void {
    const last = this.samples[this.samples.length - 1];
    if (last !== undefined && t < last.t) this.samples = this.samples.filter((s) => s.t < t);
    this.samples.push({ t, v });
    if (this.samples.length > MOST_SAMPLES || t - (this.samples[0]?.t ?? t) > MOST_S)
      this.samples.splice(0, Math.ceil(this.samples.length / 10));
  }

  clear(): void {
    this.samples = [];
  }

  /** Samples from `from` to `to`, with the one before, so that a line enters from the left. */
  between(from: number, to: number): Sample[] {
    const first = this.samples.findIndex((s) => s.t >= from);
    if (first < 0) return this.samples.slice(-1);
    const end = this.samples.findIndex((s) => s.t > to);
    return this.samples.slice(Math.max(0, first - 1), end < 0 ? undefined : end);
  }

  /** The newest sample that is not later than `t`. */
  at(t: number): Sample | undefined {
    for (let i = this.samples.length - 1; i >= 0; --i) {
      const sample = this.samples[i];
      if (sample !== undefined && sample.t <= t) return sample;
    }
    return undefined;
  }
}

/** About `most` round numbers between two others, and how many digits they need. */
export function ticks(low: number, high: number, most: number): { values: number[]; digits: number } {
  const raw = (high - low) / Math.max(1, most);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= raw * 0.999) ?? raw;
  const values: number[] = [];
  for (let k = Math.ceil(low / step - 1e-6); k * step <= high + step * 1e-6; ++k) values.push(k === 0 ? 0 : k * step);  // no -0
  return { values, digits: Math.min(12, Math.max(0, -Math.floor(Math.log10(step) + 1e-9))) };
}
