// Logarithms and powers of 2 of + - * / alone: how exact a driver's own are is not said. Errors in
// units of v = 2^-24 (powers_range.h).

const float log2_of_e = 1.44269504;

// Of a normal number above 0. ln m = 2 (t + t^3 / 3 + t^5 / 5 + ...) with t = (m - 1) / (m + 1), of
// which |t| is at most 0.1716 and what follows t^9 at most 2e-9 of the sum.
float log2_of(float x) {
    int bits = floatBitsToInt(x);
    int exponent = (bits >> 23) - 127;
    float m = intBitsToFloat((bits & 0x7fffff) | 0x3f800000);
    if (m > 1.41421354) {
        m *= 0.5;
        exponent += 1;
    }
    float t = (m - 1) / (m + 1);
    float tt = t * t;
    float sum = 2 + tt * (0.666666667 + tt * (0.4 + tt * (0.285714286 + tt * 0.222222222)));
    return float(exponent) + t * sum * log2_of_e;
}

// 0 below the smallest normal number. 2^f = 1 + f ln 2 + (f ln 2)^2 / 2 + ..., of which |f| is at
// most a half and what follows the seventh power at most 6e-9.
float exp2_of(float x) {
    if (!(x >= -126)) return 0;
    float whole = floor(x + 0.5);
    float f = (x - whole) * 0.693147181;
    float sum = 1 + f * (1 + f * (0.5 + f * (0.166666667 + f * (0.0416666667 +
                f * (0.00833333333 + f * (0.00138888889 + f * 0.000198412698))))));
    return sum * intBitsToFloat((int(whole) + 127) << 23);
}

// x^y, for y of 0 or more; 0 where x is no more than the smallest normal number.
float power_of(float x, float y) {
    return x > 1.17549435e-38 ? exp2_of(y * log2_of(x)) : 0;
}
