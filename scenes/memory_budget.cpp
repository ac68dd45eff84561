#include "scenes/memory_budget.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <utility>

namespace shadowproof {

std::string bytes_in_words(std::uint64_t bytes) {
    const auto amount = static_cast<double>(bytes);
    if (bytes >= 1'000'000'000) return fmt::format("{:.1f} GB", amount / 1e9);
    if (bytes >= 1'000'000) return fmt::format("{:.0f} MB", amount / 1e6);
    return fmt::format("{} bytes", bytes);
}

void require_memory(const MemoryBudget& budget, std::uint64_t held, const MemoryNeed& need) {
    if (held <= budget.bytes && need.bytes <= budget.bytes - held) return;
    throw Error(need.where,
                fmt::format("needs {} of memory for {} beside {} that are held, and the budget is "
                            "{} ({})",
                            bytes_in_words(need.bytes), need.what, bytes_in_words(held),
                            bytes_in_words(budget.bytes), budget.origin),
                fmt::format("{}, or give more by --memory", need.remedy));
}

MemoryHold::MemoryHold(MemoryAccount& account, std::uint64_t bytes)
    : account_(&account), bytes_(bytes) {
    account_->held_ += bytes_;
}

MemoryHold::~MemoryHold() {
    if (account_ != nullptr) account_->held_ -= bytes_;
}

MemoryHold::MemoryHold(MemoryHold&& other) noexcept
    : account_(std::exchange(other.account_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

MemoryHold& MemoryHold::operator=(MemoryHold&& other) noexcept {
    std::swap(account_, other.account_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

MemoryHold MemoryAccount::hold(const MemoryNeed& need) {
    require(need);
    return {*this, need.bytes};
}

MemoryBudget MemoryAccount::left() const {
    MemoryBudget budget = budget_;
    const std::uint64_t beside = held_ - program_bytes;
    if (budget.bytes != MemoryBudget::no_limit)
        budget.bytes = budget.bytes > beside ? budget.bytes - beside : 0;
    return budget;
}

void MemoryAccount::keep(const MemoryNeed& need) {
    require(need);
    held_ += need.bytes;
}

} // namespace shadowproof
