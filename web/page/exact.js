// SPDX-License-Identifier: MIT
// The formulas of perspective in exact arithmetic: every float, double and edge function is a rational number, and BigInt
// adds and multiplies those without rounding. A rational is [numerator, denominator], the denominator above 0.

const ZERO = [0n, 1n];

const gcd = (a, b) => {
  while (b) {
    [a, b] = [b, a % b];
  }
  return a < 0n ? -a : a;
};

function rational(numerator, denominator) {
  const sign = denominator < 0n ? -1n : 1n;
  const common = gcd(numerator, denominator) || 1n;
  return [(sign * numerator) / common, (sign * denominator) / common];
}

/** The value of a finite double, exactly. */
export function fromNumber(value) {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  const bits = view.getBigUint64(0);
  const exponent = Number((bits >> 52n) & 0x7ffn);
  const fraction = bits & 0xfffffffffffffn;
  const mantissa = (exponent ? fraction | 0x10000000000000n : fraction) * (value < 0 ? -1n : 1n);
  const power = Math.max(exponent, 1) - 1075;
  return power < 0 ? rational(mantissa, 1n << BigInt(-power)) : [mantissa << BigInt(power), 1n];
}

const plus = ([a, b], [c, d]) => rational(a * d + c * b, b * d);
const minus = (p, [c, d]) => plus(p, [-c, d]);
const times = ([a, b], [c, d]) => rational(a * c, b * d);
const over = ([a, b], [c, d]) => rational(a * d, b * c);

/** The double that is nearest, of a size that is ordinary for one. */
export function toNumber([numerator, denominator]) {
  if (numerator === 0n) {
    return 0;
  }
  const size = numerator < 0n ? -numerator : numerator;
  // 64 bits of the quotient and whether there are more: one rounding is left, Number's, to nearest.
  const shift = 64 - (size.toString(2).length - denominator.toString(2).length);
  const scaled = shift > 0 ? [size << BigInt(shift), denominator] : [size, denominator << BigInt(-shift)];
  const quotient = (scaled[0] / scaled[1]) | (scaled[0] % scaled[1] ? 1n : 0n);
  return (numerator < 0n ? -1 : 1) * Number(quotient) * 2 ** -shift;
}

const ulpOfFloat = (value) => {
  const size = Math.abs(value);
  return size < 2 ** -126 ? 2 ** -149 : 2 ** (Math.floor(Math.log2(size)) - 23);
};

const weigh = (weights, values) =>
  weights.reduce((sum, weight, i) => plus(sum, times(weight, fromNumber(values[i]))), ZERO);

// By areas on the screen: r, s, t first.
function bySnapped(edges, ws) {
  const sum = edges.reduce((total, edge) => total + BigInt(edge), 0n);
  const screen = edges.map((edge) => rational(BigInt(edge), sum));
  const parts = screen.map((weight, i) => over(weight, fromNumber(ws[i])));
  const inverseW = parts.reduce(plus);
  return { screen, inverseW, space: parts.map((part) => over(part, inverseW)) };
}

// A corner lies nowhere on the screen: P is the mixture of the corners whose X and Y, seen from P, vanish, so a : b : c are the
// 2 x 2 determinants of the other two corners. `place` is P in 1/256 pixel.
function byHomogeneous(corners, place, size) {
  const seen = corners.map(([x, y, , w]) =>
    [x, -y].map((value, k) => {
      const middle = rational(BigInt(size[k] * 128 - place[k]), 256n);
      return plus(times(fromNumber(value), rational(BigInt(size[k]), 2n)), times(fromNumber(w), middle));
    }),
  );
  const areas = seen.map((_, i) => {
    const [[x1, y1], [x2, y2]] = [seen[(i + 1) % 3], seen[(i + 2) % 3]];
    return minus(times(x1, y2), times(y1, x2));
  });
  const space = areas.map((area) => over(area, areas.reduce(plus)));
  const w = space.map((weight, i) => times(weight, fromNumber(corners[i][3])));
  const inverseW = over([1n, 1n], w.reduce(plus));
  return { screen: w.map((part) => times(part, inverseW)), inverseW, space };
}

/**
 * r, s, t, 1/W and a, b, c of a pixel, exactly: from its edge functions, or where those are NaN from the corners [X, Y, Z, W], the
 * place of the pixel's middle in 1/256 pixel, and the picture's size.
 */
export function exactWeights({ edges, corners, place, size }) {
  return edges.some(Number.isNaN)
    ? byHomogeneous(corners, place, size)
    : bySnapped(edges, corners.map((corner) => corner[3]));
}

/** A value three ways: naive and exact as doubles, and how far `written` is from exact in ULP of the largest vertex value. */
export function threeWays(weights, values, written, smooth) {
  const naive = weigh(weights.screen, values);
  const exact = weigh(weights.space, values);
  const [n, d] = minus(fromNumber(written), smooth ? exact : naive);
  const largest = Math.max(...values.map(Math.abs));
  return {
    naive: toNumber(naive),
    exact: toNumber(exact),
    error: largest === 0 ? 0 : Math.abs(toNumber([n, d])) / ulpOfFloat(largest),
  };
}
