// marks.h: a set of indices 0 .. n-1 that is emptied in no time: for searches that visit few of many elements.
#pragma once

#include "polylab/base.h"

#include <algorithm>
#include <vector>

namespace polylab {

class Marks {
public:
    // Empties the set and makes room for n indices. O(1), but for the first time and after growth.
    void clear(Index n) {
        if (static_cast<std::size_t>(n) > round_.size()) round_.resize(n, 0);
        if (now_ == std::numeric_limits<Index>::max()) {
            std::fill(round_.begin(), round_.end(), 0);
            now_ = 0;
        }
        now_++;
    }
    bool has(Index i) const { return round_[i] == now_; }
    // Whether i was not in the set.
    bool insert(Index i) {
        const bool added = round_[i] != now_;
        round_[i] = now_;
        return added;
    }
    void erase(Index i) { round_[i] = 0; }

private:
    std::vector<Index> round_;   // index -> number of the round in which it was inserted last
    Index now_ = 0;
};

}   // namespace polylab
