#include "reference/exact/exact.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <utility>

namespace shadowproof {

static_assert(GMP_NUMB_BITS == 64, "a digit of Limbs is one of GMP's");

Limbs::Limbs(double a) {
    assert(a == 0 || std::isnormal(a));
    if (a == 0) return;
    const auto bits = std::bit_cast<std::uint64_t>(a);
    // a is mantissa * 2^exponent, of 53 bits.
    const mp_limb_t mantissa = (bits & 0xfffffffffffffU) | 0x10000000000000U;
    const int exponent = static_cast<int>(bits >> 52U & 0x7ffU) - 1075;
    const unsigned shift = static_cast<unsigned>(exponent) % 64U; // not negative
    exponent_ = (exponent - static_cast<int>(shift)) / 64;
    sign_ = a < 0 ? -1 : 1;
    const mp_limb_t low = mantissa << shift;
    const mp_limb_t high = shift == 0 ? 0 : mantissa >> (64U - shift);
    if (low == 0) ++exponent_;
    if (low != 0) limbs_[count_++] = low;
    if (high != 0) limbs_[count_++] = high;
}

void Limbs::drop_leading_zeros() {
    while (count_ > 0 && limbs_[count_ - 1] == 0) --count_;
    if (count_ == 0) sign_ = 0;
}

Limbs operator*(const Limbs& a, const Limbs& b) {
    Limbs product;
    if (a.sign_ == 0 || b.sign_ == 0) return product;
    const Limbs& longer = a.count_ >= b.count_ ? a : b;
    const Limbs& shorter = &longer == &a ? b : a;
    product.count_ = a.count_ + b.count_;
    assert(product.count_ <= Limbs::capacity);
    mpn_mul(product.limbs_.data(), longer.limbs_.data(), static_cast<mp_size_t>(longer.count_),
            shorter.limbs_.data(), static_cast<mp_size_t>(shorter.count_));
    product.exponent_ = a.exponent_ + b.exponent_;
    product.sign_ = a.sign_ * b.sign_;
    product.drop_leading_zeros();
    return product;
}

/// The sign of b may be another than its own.
Limbs Limbs::sum(const Limbs& a, const Limbs& b, int sign_of_b) {
    if (b.sign_ == 0) return a;
    if (a.sign_ == 0) {
        Limbs result = b;
        result.sign_ = sign_of_b;
        return result;
    }
    return a.exponent_ <= b.exponent_ ? sum_from(a, a.sign_, b, sign_of_b)
                                      : sum_from(b, sign_of_b, a, a.sign_);
}

/// Neither is zero; `low` begins with the lower digit, or the same.
Limbs Limbs::sum_from(const Limbs& low, int sign_of_low, const Limbs& high, int sign_of_high) {
    const auto gap = static_cast<std::size_t>(high.exponent_ - low.exponent_);
    Limbs aligned; // high, with zeros down to the first digit of low
    aligned.count_ = gap + high.count_;
    assert(std::max(aligned.count_, low.count_) < capacity);
    std::fill_n(aligned.limbs_.begin(), gap, 0);
    std::copy_n(high.limbs_.begin(), high.count_,
                aligned.limbs_.begin() + static_cast<std::ptrdiff_t>(gap));

    Limbs result;
    result.exponent_ = low.exponent_;
    const bool more_in_low = low.count_ != aligned.count_
                                 ? low.count_ > aligned.count_
                                 : mpn_cmp(low.limbs_.data(), aligned.limbs_.data(),
                                           static_cast<mp_size_t>(low.count_)) > 0;
    const Limbs& larger = more_in_low ? low : aligned;
    const Limbs& smaller = more_in_low ? aligned : low;
    result.sign_ = more_in_low ? sign_of_low : sign_of_high;
    result.count_ = larger.count_;
    const auto combine = sign_of_low == sign_of_high ? mpn_add : mpn_sub;
    const mp_limb_t carry =
        combine(result.limbs_.data(), larger.limbs_.data(), static_cast<mp_size_t>(larger.count_),
                smaller.limbs_.data(), static_cast<mp_size_t>(smaller.count_));
    if (carry != 0) result.limbs_[result.count_++] = carry;
    result.drop_leading_zeros();
    return result;
}

Dyadic dyadic(double a) {
    assert(std::isfinite(a));
    int exponent = 0;
    // 53 bits: the product is an integer.
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(a, &exponent), 53));
    exponent -= 53;
    if (mantissa == 0) return {};
    const int zeros = __builtin_ctzll(static_cast<std::uint64_t>(mantissa));
    return {mpz_class(static_cast<long>(mantissa >> zeros)), exponent + zeros};
}

namespace {

/// The mantissa that `number` has at an exponent not above its own.
mpz_class mantissa_at(long exponent, const Dyadic& number) {
    return number.mantissa << static_cast<mp_bitcnt_t>(number.exponent - exponent);
}

/// a + factor b, factor 1 or -1. The exponent of a zero is ignored: it would only make the other's
/// mantissa longer.
Dyadic sum(const Dyadic& a, const Dyadic& b, int factor) {
    if (b.sign() == 0) return a;
    if (a.sign() == 0) return {b.mantissa * factor, b.exponent};
    const long exponent = std::min(a.exponent, b.exponent);
    return {mantissa_at(exponent, a) + factor * mantissa_at(exponent, b), exponent};
}

} // namespace

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    return sum(a, b, 1);
}
Dyadic operator-(const Dyadic& a, const Dyadic& b) {
    return sum(a, b, -1);
}

} // namespace shadowproof
