#include "polylab/patch.h"

#include <algorithm>

namespace polylab {

Index EffectFinder::begin(const Labeling& labels, const LabelingGraph& graph, const TurningPoints& turning, const Patch& patch) {
    labels_ = &labels;
    graph_ = &graph;
    turning_ = &turning;
    effect_ = {};
    note_changes(patch);
    count_features();
    return effect_.lost_features;
}

// First goes what is no more, then comes what is new, the quick things first: so the number of invalid elements only grows.
Effect EffectFinder::finish(Index most_invalid) {
    if (changes_.empty()) return effect_;
    find_zone();
    leave_old_charts();
    leave_old_boundaries();
    judge_corners();
    if (effect_.invalid > most_invalid) return effect_;
    join_pieces();
    trace_boundaries();
    judge_charts();
    if (effect_.invalid > most_invalid) return effect_;
    count_turns();
    return effect_;
}

void EffectFinder::describe(GraphChange& change) {
    change.facets.clear();
    for (const Relabel& r : changes_) change.facets.push_back(r.facet);
    change.fans = fans_;
    change.same_charts = same_charts(change.to);
    if (change.same_charts) return;
    const Index old = static_cast<Index>(graph_->charts.size());
    change.most_chart = old + static_cast<Index>(zone_.size());
    change.charts = graph_->chart;
    for (const Index c : old_charts_) rest_[c] = root(rest_[c]);
    for (Index f = 0; f < mesh_.facets(); f++) {
        Index& c = change.charts[f];
        if (met_chart_.has(c)) c = old + (has_piece_.has(f) ? root(piece_[f]) : rest_[c]);
    }
}

// Whether each old chart keeps one piece, its own, and what changes goes to such pieces; `to`: into which charts.
bool EffectFinder::same_charts(std::vector<Index>& to) {
    std::vector<Index> piece(old_charts_.size(), kNone), chart(zone_.size(), kNone);
    for (const Index f : zone_) {
        if (new_label_[f] != kNoLabel) continue;
        const Index c = graph_->chart[f], own = root(piece_[f]);
        Index& known = piece[met_chart_.number(c)];
        if (known == own) continue;
        if (known != kNone || chart[own] != kNone) return false;   // it falls apart, or is one with another
        known = own;
        chart[own] = c;
    }
    if (std::count(piece.begin(), piece.end(), kNone) > 0) return false;
    to.clear();
    for (const Relabel& r : changes_) {
        const Index from = graph_->chart[r.facet], c = chart[root(piece_[r.facet])];
        if (c == kNone || r.facet == graph_->charts[from].smallest_facet || r.facet < graph_->charts[c].smallest_facet)
            return false;
        to.push_back(c);
    }
    return true;
}

void EffectFinder::note_changes(const Patch& patch) {
    new_label_.resize(mesh_.facets(), kNoLabel);
    for (const Relabel& r : changes_) new_label_[r.facet] = kNoLabel;   // those of the last patch
    changes_.clear();
    for (const Relabel& r : patch) {
        if (new_label_[r.facet] == kNoLabel) changes_.push_back(r);
        new_label_[r.facet] = r.label;
    }
    std::size_t kept = 0;
    for (const Relabel& r : changes_) {
        Label& label = new_label_[r.facet];
        if (label == (*labels_)[r.facet])
            label = kNoLabel;
        else
            changes_[kept++] = {r.facet, label};
    }
    changes_.resize(kept);
}

// All borders that the patch makes, unmakes or turns into others touch the vertices of changed facets, within a fan of which
// such a facet is part; so do the corners that come, go or change.
void EffectFinder::find_zone() {
    fans_.clear();
    zone_.clear();
    in_fan_.clear(mesh_.halfedges());
    has_piece_.clear(mesh_.facets());
    piece_.resize(mesh_.facets());
    for (const Relabel& r : changes_)
        for (Index h = 3 * r.facet; h < 3 * r.facet + 3; h++) {
            if (in_fan_.has(h)) continue;
            fans_.push_back(h);
            Index around = h;
            do {
                in_fan_.insert(around);
                const Index f = facet(around);
                if (has_piece_.insert(f)) {
                    piece_[f] = static_cast<Index>(zone_.size());
                    zone_.push_back(f);
                }
                around = mesh_.ccw(around);
            } while (around != h);
        }
}

void EffectFinder::count_features() {
    for (const Relabel& r : changes_)
        for (Index h = 3 * r.facet; h < 3 * r.facet + 3; h++) {
            const bool second_time = new_label_[mesh_.right(h)] != kNoLabel && mesh_.opposite[h] < h;
            if (mesh_.feature[h] && !second_time) effect_.lost_features += graph_->is_border(h) - is_border(h);
        }
}

// ---- new charts

Index EffectFinder::root(Index piece) {
    while (parent_[piece] != piece) piece = parent_[piece] = parent_[parent_[piece]];
    return piece;
}

void EffectFinder::leave_old_charts() {
    old_charts_.clear();
    met_chart_.clear(static_cast<Index>(graph_->charts.size()));
    cut_chart_.clear(static_cast<Index>(graph_->charts.size()));
    rest_.resize(std::max(rest_.size(), graph_->charts.size()));
    for (const Relabel& r : changes_) cut_chart_.insert(graph_->chart[r.facet]);
    for (const Index f : zone_) {
        const Index c = graph_->chart[f];
        if (!met_chart_.insert(c)) continue;
        old_charts_.push_back(c);
        rest_[c] = piece_[f];
        effect_.charts--;
        effect_.invalid -= !graph_->charts[c].valid;
    }
}

// Which facets of the zone will be in one chart.
void EffectFinder::join_pieces() {
    const Index n = static_cast<Index>(zone_.size());
    parent_.resize(n);
    for (Index i = 0; i < n; i++) parent_[i] = i;
    for (const Index f : zone_)
        for (Index h = 3 * f; h < 3 * f + 3; h++)
            if (h < mesh_.opposite[h] && has_piece_.has(mesh_.right(h)) && !is_border(h))
                unite(piece_[f], piece_[mesh_.right(h)]);

    for (const Index f : zone_) {   // connected outside the zone
        const Index c = graph_->chart[f];
        if (!cut_chart_.has(c)) unite(piece_[f], rest_[c]);
    }
    for (const Index c : old_charts_)
        if (cut_chart_.has(c)) search_cut_chart(c);
}

// What is left of a chart may be connected outside the zone. One search per piece, in turn a facet each, until they met or
// all but one have seen the whole of their piece: so the largest piece is never walked through.
void EffectFinder::search_cut_chart(Index chart) {
    struct Search {
        Index piece;
        std::vector<Index> facets;   // met so far
        std::size_t done = 0;        // those of which the neighbours are met
    };
    std::vector<Search> searches;
    const auto left = [&](Index f) { return graph_->chart[f] == chart && new_label_[f] == kNoLabel; };
    for (const Index f : zone_) {
        if (!left(f)) continue;
        const Index piece = root(piece_[f]);
        auto search = std::find_if(searches.begin(), searches.end(), [&](const Search& s) { return s.piece == piece; });
        if (search == searches.end()) search = searches.insert(search, {piece, {}});
        search->facets.push_back(f);
    }
    const auto several_go_on = [&] {
        Index only = kNone;
        for (const Search& s : searches) {
            if (s.done == s.facets.size()) continue;
            if (only != kNone && root(s.piece) != only) return true;
            only = root(s.piece);
        }
        if (only != kNone) rest_[chart] = only;
        return false;
    };
    while (several_go_on())
        for (Search& s : searches) {
            if (s.done == s.facets.size()) continue;
            const Index f = s.facets[s.done++];
            for (Index h = 3 * f; h < 3 * f + 3; h++) {
                const Index other = mesh_.right(h);
                if (!left(other)) continue;
                if (has_piece_.insert(other)) {
                    piece_[other] = s.piece;
                    s.facets.push_back(other);
                } else {
                    unite(piece_[other], s.piece);
                }
            }
        }
}

// ---- new boundaries

Index EffectFinder::next_border_ccw(Index h) const {
    do h = mesh_.ccw(h);
    while (!is_border(h));
    return h;
}

// Whether three or more borders meet where this one starts, within its fan.
bool EffectFinder::at_corner(Index border) const {
    const Index second = next_border_ccw(border), third = next_border_ccw(second);
    return second != border && third != border;
}

void EffectFinder::trace_boundaries() {
    boundaries_.assign(zone_.size(), 0);
    traced_.clear(mesh_.halfedges());
    paths_.clear();
    new_boundaries_.clear();
    for (const Index fan : fans_) {
        Index h = fan;
        do {
            if (is_border(h) && !traced_.has(h)) trace(h);
            h = mesh_.ccw(h);
        } while (h != fan);
    }
}

// The whole boundary of border h, as in build_graph().
void EffectFinder::trace(Index h) {
    Index first = h;
    while (!at_corner(first)) {
        const Index before = mesh_.opposite[next_border_ccw(first)];
        if (before == h) {
            first = h;
            break;
        }
        first = before;
    }
    const Index begin = static_cast<Index>(paths_.size()), old = graph_->boundary[h];
    const Label left = label(mesh_.left(h)), right = label(mesh_.right(h));
    bool is_old = old != kNone && (*labels_)[mesh_.left(h)] == left && (*labels_)[mesh_.right(h)] == right;
    Index at = first, smallest = std::numeric_limits<Index>::max();
    bool corner = false;
    do {
        const Index back = mesh_.opposite[at];
        paths_.push_back(at);
        traced_.insert(at);
        traced_.insert(back);
        smallest = std::min({smallest, at, back});
        is_old = is_old && graph_->boundary[at] == old;
        corner = at_corner(back);
        if (corner) break;
        at = next_border_ccw(back);
    } while (at != first);
    boundaries_[root(piece_[mesh_.left(h)])]++;
    boundaries_[root(piece_[mesh_.right(h)])]++;

    const Range path = {begin, static_cast<Index>(paths_.size())};
    if (is_old && path.size() == graph_->boundaries[old].halfedges.size()) {   // it is the same, though it passes here
        effect_.invalid += !graph_->boundaries[old].valid;
        effect_.turning_points += turning_->of(old).size();
        return;
    }
    const int axis = boundary_axis(left, right);
    if (axis != kNone && path.size() > 1)
        new_boundaries_.push_back({path, axis, !corner || mesh_.from(first) == mesh_.to(paths_.back())});
    bool valid = axis != kNone || graph_->allow_opposite;
    if (valid && axis == kNone) {   // is_convex() depends on the direction
        const bool with_smallest = label(facet(smallest)) == left;
        for (Index i = path.first; i < path.last; i++)
            valid = valid && !is_convex(mesh_, with_smallest ? paths_[i] : mesh_.opposite[paths_[i]]);
    }
    effect_.invalid += !valid;
}

void EffectFinder::count_turns() {
    for (const Traced& b : new_boundaries_) {
        const std::vector<Index> path(paths_.begin() + b.path.first, paths_.begin() + b.path.last);
        effect_.turning_points += static_cast<Index>(chain_turns(make_chain(mesh_, path, b.axis), b.closed).size());
    }
}

void EffectFinder::leave_old_boundaries() {
    met_boundary_.clear(static_cast<Index>(graph_->boundaries.size()));
    for (const Index fan : fans_) {
        Index h = fan;
        do {
            const Index b = graph_->boundary[h];
            if (b != kNone && met_boundary_.insert(b)) {
                effect_.invalid -= !graph_->boundaries[b].valid;
                effect_.turning_points -= turning_->of(b).size();
            }
            h = mesh_.ccw(h);
        } while (h != fan);
    }
}

// ---- validity of charts and corners

void EffectFinder::judge_charts() {
    for (const Index c : old_charts_) {
        const Chart& chart = graph_->charts[c];
        // Boundaries that don't touch the zone stay, with one of the charts that come from this one.
        for (Index i = chart.boundaries.first; i < chart.boundaries.last; i++) {
            const Index b = graph_->chart_boundaries[i];
            if (met_boundary_.has(b)) continue;
            const Index h = graph_->halfedges[graph_->boundaries[b].halfedges.first];
            const Index f = graph_->boundaries[b].left == c ? mesh_.left(h) : mesh_.right(h);
            boundaries_[root(has_piece_.has(f) ? piece_[f] : rest_[c])]++;
        }
    }
    for (Index piece = 0; piece < static_cast<Index>(zone_.size()); piece++) {
        if (root(piece) != piece) continue;
        effect_.charts++;
        effect_.invalid += boundaries_[piece] < kLeastBoundaries;
    }
}

void EffectFinder::judge_corners() {
    met_vertex_.clear(mesh_.vertices());
    invalid_vertex_.clear(mesh_.vertices());
    for (const Index fan : fans_) {
        axes_.clear();
        Index h = fan;
        do {
            if (is_border(h)) axes_.push_back(boundary_axis(label(mesh_.left(h)), label(mesh_.right(h))));
            h = mesh_.ccw(h);
        } while (h != fan);
        if (axes_.size() >= 3 && !valid_ring(axes_, graph_->allow_opposite)) invalid_vertex_.insert(mesh_.from(fan));
    }
    for (const Index fan : fans_) {
        const Index v = mesh_.from(fan), c = graph_->corner[v];
        if (!met_vertex_.insert(v)) continue;
        bool invalid = invalid_vertex_.has(v);
        if (c != kNone) {
            const Corner& corner = graph_->corners[c];
            effect_.invalid -= !corner.valid;
            for (Index r = corner.rings.first; r < corner.rings.last; r++) {   // of fans that the patch does not touch
                const Ring& ring = graph_->rings[r];
                invalid = invalid || (!ring.valid && !in_fan_.has(graph_->ring_halfedges[ring.halfedges.first]));
            }
        }
        effect_.invalid += invalid;
    }
}

}   // namespace polylab
