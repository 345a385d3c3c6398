// marks.h: sets of indices for searches that visit few of many elements, and fingerprints of what they met.
#pragma once

#include "polylab/base.h"

#include <algorithm>
#include <vector>

namespace polylab {

// A set of indices 0 .. n-1 that is emptied in no time: for memory that is kept between searches. Each index has a number: how
// many were inserted before it.
class Marks {
public:
    // Empties the set and makes room for n indices. O(1), but for the first time, after growth, and once in 2^31 insertions.
    void clear(Index n) {
        if (static_cast<std::size_t>(n) > mark_.size()) mark_.resize(n);
        first_ = next_;
        if (first_ <= std::numeric_limits<Index>::max() - n) return;
        std::fill(mark_.begin(), mark_.end(), 0);
        first_ = next_ = 1;
    }
    bool has(Index i) const { return mark_[i] >= first_; }
    // kNone if i is not in the set.
    Index number(Index i) const { return has(i) ? mark_[i] - first_ : kNone; }
    // Whether i was not in the set.
    bool insert(Index i) {
        if (has(i)) return false;
        mark_[i] = next_++;
        return true;
    }

private:
    std::vector<Index> mark_;   // index -> first_ + its number, or less if it is not in the set
    Index first_ = 1, next_ = 1;
};

// A number for a list of others: FNV-1a, a word at a time. Two lists with the same one are taken for equal.
class Fingerprint {
public:
    void mix(Index i) { value_ = (value_ ^ static_cast<std::uint32_t>(i)) * 1099511628211u; }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

// A set of few indices, in memory of its own size: for what a single search meets. A table with open addressing; nothing
// iterates over it, so that its order is nobody's concern. Numbers as above.
class IndexSet {
public:
    IndexSet() = default;
    template <class List>
    explicit IndexSet(const List& indices) {
        for (const Index i : indices) insert(i);
    }

    bool has(Index i) const { return number(i) != kNone; }
    // kNone if i is not in the set.
    Index number(Index i) const {
        if (table_.empty()) return kNone;
        const Entry& entry = table_[place(i)];
        return entry.index == i ? entry.number : kNone;
    }
    // Whether i was not in the set. i is not negative.
    bool insert(Index i) {
        if (2 * (static_cast<std::size_t>(count_) + 1) > table_.size()) grow();
        Entry& entry = table_[place(i)];
        if (entry.index == i) return false;
        entry = {i, count_++};
        return true;
    }

private:
    struct Entry {
        Index index = kNone, number = kNone;
    };

    // Where i is, or where it would go.
    std::size_t place(Index i) const {
        const std::size_t mask = table_.size() - 1;
        std::size_t at = (static_cast<std::uint32_t>(i) * 2654435769u >> 7) & mask;
        while (table_[at].index != kNone && table_[at].index != i) at = (at + 1) & mask;
        return at;
    }
    void grow() {
        const std::vector<Entry> old = std::move(table_);
        table_.assign(old.empty() ? 64 : 2 * old.size(), {});
        for (const Entry& entry : old)
            if (entry.index != kNone) table_[place(entry.index)] = entry;
    }

    std::vector<Entry> table_;   // a power of two, at most half full
    Index count_ = 0;
};

}   // namespace polylab
