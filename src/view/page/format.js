// Numbers and texts for people.

/** A number with at most `digits` significant digits, without trailing zeros. */
export function number(value, digits = 4) {
  if (Number.isNaN(value)) return 'no value';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  const size = Math.abs(value);
  let text;
  if (size === 0) text = '0';
  else if (size >= 1e6 || size < 1e-4) text = value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  else {
    text = value.toPrecision(digits);
    text = text.includes('e') ? String(Number(text)) : text.includes('.') ? text.replace(/\.?0+$/, '') : text;
  }
  return text.replaceAll('-', '−');
}

/** How many significant digits tell numbers that differ by `step` apart; at least `least`. */
export function digitsFor(value, step, least = 4) {
  const digits = Math.ceil(Math.log10(Math.abs(value) / step));
  return step > 0 && digits > least ? Math.min(digits, 15) : least;
}

/** A number with as many decimals as its step needs. */
export function stepped(value, step) {
  if (!Number.isFinite(value)) return number(value);
  const decimals = Math.ceil(-Math.log10(step));
  if (!(step > 0) || decimals > 8 || Math.abs(value) >= 1e15) return number(value, 6);
  return value.toFixed(Math.max(0, decimals)).replace('-', '−');
}

export const count = (value) => value.toLocaleString('en');
export const withUnit = (text, unit) => (unit ? `${text} ${unit}` : text);

/** The least of 1, 2 and 5 times a power of ten that is not below `value`. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= value * (1 - 1e-9));
}

/** Round numbers in a range, about `wanted` of them. */
export function ticks(low, high, wanted = 4) {
  if (!(high > low)) return [low];
  const step = roundUp((high - low) / wanted);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9 && found.length < 20; ++k) found.push(k * step);
  return found.map((value) => Number(value.toPrecision(15)));
}

/** Logarithms to base 10 of round numbers, between the ends of a scale, which are logarithms too. */
export function logarithmicTicks(low, high) {
  if (!(high - low >= 1)) return ticks(10 ** low, 10 ** high).map(Math.log10);
  const found = [];
  const digits = high - low < 2.5 ? [1, 2, 5] : [1];
  const every = Math.ceil((high - low) / 6);
  for (let power = Math.floor(low); power <= high; ++power)
    for (const digit of power % every === 0 ? digits : []) {
      const place = power + Math.log10(digit);
      if (place >= low - 1e-9 && place <= high + 1e-9) found.push(place);
    }
  return found;
}
