// SPDX-License-Identifier: MIT
// Large scans come as text, so digits are read 8 at a time, in the bytes of a word. Three ways make a double of them,
// each exactly rounded for up to a hundred characters, and nothing depends on the locale:
// - the product or the quotient of two doubles that are exact (Clinger, How to read floating point numbers accurately,
//   1990), for up to 15 digits;
// - whole numbers of 128 bits, for up to 19 digits and a power of ten that fits a word without its twos. These are what
//   programs print that write doubles whole;
// - strtod for all others.
#include "decimal.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD = 8, MOST_DIGITS = 19, MOST_FIVES = 27 }; // 10^19 and 5^27 are below 2^64

static const uint64_t tens[WORD + 1] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

// Load 8 characters, the first into the lowest byte. Where fewer are left, zeros follow, which are no digits. What
// stands between `start` and `text` is readable.
static uint64_t load(const char *start, const char *text, const char *end)
{
    const size_t left = (size_t)(end - text);
    uint64_t word = 0;
    if (left >= WORD) {
        memcpy(&word, text, WORD);
    } else if (end - start >= WORD) {
        memcpy(&word, end - WORD, WORD);
    } else {
        memcpy(&word, text, left);
    }
    if (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) {
        word = __builtin_bswap64(word);
    }
    const bool is_late = left < WORD && end - start >= WORD;
    return is_late ? (left == 0 ? 0 : word >> 8 * (WORD - left)) : word;
}

// Return how many of the characters of a word are digits before the first that is none, and their value.
static unsigned read_word(uint64_t characters, uint32_t *value)
{
    const uint64_t word = characters ^ 0x3030303030303030u; // a digit is what it stands for
    // A byte above 9 has its highest bit set here. A carry may only set bits behind the first such byte.
    const uint64_t others = (word | (word + 0x7676767676767676u)) & 0x8080808080808080u;
    const unsigned count = others == 0 ? WORD : (unsigned)__builtin_ctzll(others) / 8;
    if (count == 0) {
        *value = 0;
        return 0;
    }
    // Digits of a shorter number move to the end, so that zeros lead it. Pairs become numbers below 100, then four
    // digits and eight.
    const uint64_t digits = word << 8 * (WORD - count);
    const uint64_t pairs = 10 * digits + (digits >> 8), mask = 0x000000ff000000ffu;
    const uint64_t fours = (pairs & mask) * (100 + (UINT64_C(1000000) << 32)) +
                           (pairs >> 16 & mask) * (1 + (UINT64_C(10000) << 32));
    *value = (uint32_t)(fours >> 32);
    return count;
}

unsigned scene_decimal_digits(const char *text, const char *end, uint32_t *value)
{
    return read_word(load(text, text, end), value);
}

// A number as it is written: mantissa · 10^power, unless it has more than MOST_DIGITS.
struct decimal {
    uint64_t mantissa;
    int64_t digits, power;
    bool is_negative;
};

// Add the digits at `text` to the mantissa. Return where they end.
static const char *read_digits(const char *start, const char *text, const char *end, struct decimal *decimal)
{
    unsigned count = WORD;
    while (count == WORD) {
        uint32_t value;
        count = read_word(load(start, text, end), &value);
        text += count;
        decimal->digits += count;
        // More digits may run over, and are not used then.
        decimal->mantissa = decimal->mantissa * tens[count] + value;
    }
    return text;
}

// Read "e-12" at `c`. Return where it ends, which is `c` when there is no exponent.
static const char *read_exponent(const char *c, const char *end, int *exponent)
{
    *exponent = 0;
    if (c == end || (*c != 'e' && *c != 'E')) {
        return c;
    }
    const char *digit = c + 1;
    const bool negative = digit < end && *digit == '-';
    digit += digit < end && (*digit == '-' || *digit == '+');
    for (; digit < end && *digit >= '0' && *digit <= '9'; c = ++digit) {
        *exponent = *exponent < 100000 ? *exponent * 10 + (*digit - '0') : *exponent;
    }
    *exponent = negative ? -*exponent : *exponent;
    return c;
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;

// Return whole · 2^exponent, to the nearest double and among two of them to the even one. With `rest`, something below
// the last bit is left, and `whole` has more than 64 bits. The result is a normal number.
static double round_wide(wide whole, bool rest, int exponent)
{
    enum { PRECISION = 53 };
    const uint64_t high = (uint64_t)(whole >> 64), low = (uint64_t)whole;
    const int bits = high != 0 ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll(low);
    const int shift = bits > PRECISION ? bits - PRECISION : 0;
    uint64_t kept = (uint64_t)(whole >> shift);
    if (shift > 0) {
        const wide below = whole & (((wide)1 << shift) - 1), half = (wide)1 << (shift - 1);
        kept += below > half || (below == half && (rest || kept % 2 == 1));
    }
    const uint64_t scale_bits = (uint64_t)(exponent + shift + 1023) << 52;
    double scale;
    memcpy(&scale, &scale_bits, sizeof scale);
    return (double)kept * scale;
}

// Convert a number of at most MOST_DIGITS digits that is not 0, with a power of at most MOST_FIVES either way.
static double convert_wide(uint64_t mantissa, int power)
{
    static const uint64_t fives[MOST_FIVES + 1] = {
        1u,
        5u,
        25u,
        125u,
        625u,
        3125u,
        15625u,
        78125u,
        390625u,
        1953125u,
        9765625u,
        48828125u,
        244140625u,
        1220703125u,
        6103515625u,
        30517578125u,
        152587890625u,
        762939453125u,
        3814697265625u,
        19073486328125u,
        95367431640625u,
        476837158203125u,
        2384185791015625u,
        11920928955078125u,
        59604644775390625u,
        298023223876953125u,
        1490116119384765625u,
        7450580596923828125u,
    };
    if (power >= 0) {
        return round_wide((wide)mantissa * fives[power], false, power);
    }
    // The quotient has more than 64 bits, as the divisor has fewer than 64.
    const int shift = 64 + __builtin_clzll(mantissa);
    const wide dividend = (wide)mantissa << shift, quotient = dividend / fives[-power];
    return round_wide(quotient, quotient * fives[-power] != dividend, power - shift);
}

static bool fits_wide(const struct decimal *decimal)
{
    return decimal->mantissa != 0 && decimal->digits <= MOST_DIGITS && decimal->power >= -MOST_FIVES &&
           decimal->power <= MOST_FIVES;
}
#else
static double convert_wide(uint64_t mantissa, int power)
{
    (void)power;
    return (double)mantissa;
}

static bool fits_wide(const struct decimal *decimal)
{
    (void)decimal;
    return false;
}
#endif

// Convert digits, `whole` of which are before the point, times 10^exponent. Those after the hundredth count as 0.
static double convert_slowly(const char *digits, size_t length, int64_t whole, int exponent)
{
    enum { MOST = 100 };
    char text[128];
    const size_t kept = length < MOST ? length : MOST;
    const long long power = exponent + (whole > MOST ? whole - MOST : 0);
    memcpy(text, digits, kept);
    snprintf(text + kept, sizeof text - kept, "e%lld", power);
    return strtod(text, NULL);
}

static bool is_exact(const struct decimal *decimal)
{
    return decimal->digits <= MOST_DIGITS && decimal->mantissa <= (uint64_t)1 << 53 &&
           decimal->power >= -22 && decimal->power <= 22;
}

static double convert_exact(const struct decimal *decimal)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const double mantissa = (double)decimal->mantissa;
    return decimal->power < 0 ? mantissa / powers[-decimal->power] : mantissa * powers[decimal->power];
}

const char *scene_decimal_read(const char *text, const char *end, double *value)
{
    struct decimal decimal = {.is_negative = text < end && *text == '-'};
    const char *const digits = text + (text < end && (*text == '-' || *text == '+'));
    const char *c = read_digits(text, digits, end, &decimal);
    const int64_t before = decimal.digits;
    if (c < end && *c == '.') {
        c = read_digits(text, c + 1, end, &decimal);
    }
    if (decimal.digits == 0) {
        return NULL;
    }
    const size_t length = (size_t)(c - digits);
    int exponent = 0;
    if (c < end && (*c == 'e' || *c == 'E')) {
        c = read_exponent(c, end, &exponent);
    }
    decimal.power = exponent - (decimal.digits - before);
    const double size = is_exact(&decimal)    ? convert_exact(&decimal)
                        : fits_wide(&decimal) ? convert_wide(decimal.mantissa, (int)decimal.power)
                                              : convert_slowly(digits, length, before, exponent);
    *value = decimal.is_negative ? -size : size;
    return c;
}
