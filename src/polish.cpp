#include "polylab/polish.h"

#include "polylab/initial_labeling.h"

#include <algorithm>
#include <set>

namespace polylab {

namespace {

constexpr double kDataScale = 500;           // times 1 - cosine; an edge costs up to 100 at compactness 1
constexpr int kBandRings[] = {0, 1, 3};      // of facets around those beside a boundary, each time added to those before
constexpr int kBandCompactness[] = {0, 3};   // 0: every facet by itself; the score refuses what is too ragged
constexpr double kAcross = 0.1;   // cosine of normal and label, 84 degrees: below this the facet stands across its label
constexpr Index kMostPolishProposals = 20000;   // as in the routines; parts need up to 3000

}   // namespace

Proposals Redraw::operator()(const State& state, const std::vector<Index>& facets, int compactness) {
    Occurs occurs = {};
    labels_.clear();
    sites_.clear(mesh_.facets());
    for (const Index f : facets) {
        sites_.insert(f);
        labels_.push_back(state.labels[f]);
        occurs[state.labels[f]] = true;
        for (Index h = 3 * f; h < 3 * f + 3; h++) occurs[state.labels[mesh_.right(h)]] = true;
    }
    if (compactness == 0)
        cut_without_edges(facets, occurs);
    else
        cut(state, facets, occurs, compactness);
    return changes(state, facets);
}

Index Redraw::data_cost(Index f, Label l) const { return static_cast<Index>(kDataScale * (1 - along(mesh_.normal[f], l)) + 0.5); }

void Redraw::cut(const State& state, const std::vector<Index>& facets, const Occurs& occurs, int compactness) {
    std::vector<std::int16_t>& pairwise = pairwise_[compactness];
    pairwise.resize(mesh_.halfedges(), kNone);
    set_local_energy(
        energy_, mesh_, state.labels, facets, sites_, [&](Index f, Label l) { return occurs[l] ? data_cost(f, l) : 0; },
        [&](Index h) {
            std::int16_t& cost = pairwise[mesh_.edge(h)];
            if (cost == kNone) {
                const Vec3 &n = mesh_.normal[mesh_.left(h)], &m = mesh_.normal[mesh_.right(h)];
                cost = static_cast<std::int16_t>(mesh_.feature[h] ? 0 : pairwise_cost(n, m, compactness));
            }
            return static_cast<Index>(cost);
        });
    expansion_.begin(labels_);
    for (Label l = 0; l < kLabels; l++)
        if (occurs[l]) expansion_.move(l);
    labels_ = expansion_.labels();
}

// The same moves where edges cost nothing, so that every facet decides for itself.
void Redraw::cut_without_edges(const std::vector<Index>& facets, const Occurs& occurs) {
    costs_.clear();
    for (std::size_t i = 0; i < facets.size(); i++) costs_.push_back(data_cost(facets[i], labels_[i]));
    for (Label l = 0; l < kLabels; l++) {
        if (!occurs[l]) continue;
        bool gains = false;
        for (std::size_t i = 0; i < facets.size() && !gains; i++) gains = data_cost(facets[i], l) < costs_[i];
        for (std::size_t i = 0; i < facets.size() && gains; i++) {
            const Index cost = data_cost(facets[i], l);
            if (cost > costs_[i]) continue;   // tie: taking it, as in all moves
            costs_[i] = cost;
            labels_[i] = l;
        }
    }
}

Proposals Redraw::changes(const State& state, const std::vector<Index>& facets) const {
    std::vector<char> differs(facets.size());
    Patch all;
    for (std::size_t i = 0; i < facets.size(); i++) {
        differs[i] = labels_[i] != state.labels[facets[i]];
        if (differs[i]) all.push_back({facets[i], labels_[i]});
    }
    std::sort(all.begin(), all.end(), [](const Relabel& a, const Relabel& b) { return a.facet < b.facet; });   // all different
    Proposals parts;
    for (const Relabel& seed : all) {
        const Index first = sites_.number(seed.facet);
        if (!differs[first]) continue;   // in a part already
        differs[first] = 0;
        std::vector<Index> sites = {first};
        Patch part;
        for (std::size_t i = 0; i < sites.size(); i++) {
            const Index f = facets[sites[i]];
            part.push_back({f, labels_[sites[i]]});
            for (Index h = 3 * f; h < 3 * f + 3; h++) {
                const Index beside = sites_.number(mesh_.right(h));
                if (beside == kNone || !differs[beside]) continue;
                differs[beside] = 0;
                sites.push_back(beside);
            }
        }
        parts.push_back(std::move(part));
    }
    if (parts.size() > 1) parts.insert(parts.begin(), std::move(all));
    return parts;
}

namespace {

class Polish {
public:
    Polish(const TriMesh& mesh, State state, const RoutineOptions& options)
        : mesh_(mesh), options_(options), judge_(mesh, options.allow_opposite, options.locks), redraw_(mesh),
          state_(std::move(state)) {}

    // In rounds: what one round has changed is where the next one looks.
    State run(Labeling before) {
        for (Index h = 0; h < mesh_.halfedges(); h++)
            if (mesh_.feature[h]) features_.push_back(h);
        face_tried_.clear(mesh_.facets());
        for (const Index h : features_)
            if (!state_.graph.is_border(h)) relabel_face(mesh_.left(h));
        while (note_changes(before) && !over()) {
            before = state_.labels;
            for (Index b = 0; b < static_cast<Index>(state_.graph.boundaries.size()); b++) redraw_boundary(b);
            turned_.clear(mesh_.facets());
            for (Index f = 0; f < mesh_.facets(); f++)
                if (near_.has(f) && points_away(f) && !turned_.has(f)) turn(f);
            face_tried_.clear(mesh_.facets());
            for (const Index h : features_)
                if (!state_.graph.is_border(h) && near_.has(mesh_.left(h))) relabel_face(mesh_.left(h));
        }
        return std::move(state_);
    }

private:
    bool over() const { return proposals_tried_ >= kMostPolishProposals || (options_.stop && options_.stop()); }

    // The facets that differ, with those that share an edge with them; whether there are any.
    bool note_changes(const Labeling& before) {
        bool any = false;
        near_.clear(mesh_.facets());
        for (Index f = 0; f < mesh_.facets(); f++) {
            if (state_.labels[f] == before[f]) continue;
            any = true;
            near_.insert(f);
            for (Index h = 3 * f; h < 3 * f + 3; h++) near_.insert(mesh_.right(h));
        }
        return any;
    }
    bool points_away(Index f) const { return along(mesh_.normal[f], state_.labels[f]) < kAway; }

    // Facets, all different, that are to be widened by rings of those that touch them.
    void begin_band(std::vector<Index> facets) {
        band_ = std::move(facets);
        in_.clear(mesh_.facets());
        for (const Index f : band_) in_.insert(f);
        touched_.clear(mesh_.vertices());
        inner_ = 0;
    }
    void widen_band(int rings) {
        for (int r = 0; r < rings; r++) {
            const std::size_t end = band_.size();
            for (; inner_ < end; inner_++)
                for (Index h = 3 * band_[inner_]; h < 3 * band_[inner_] + 3; h++)
                    if (touched_.insert(mesh_.from(h)))
                        mesh_.for_each_leaving(mesh_.from(h), [&](Index around) {
                            if (in_.insert(facet(around))) band_.push_back(facet(around));
                        });
        }
    }

    // Of a patch, as far as it matters whether it is better than the bound: where nothing is invalid and nothing turns, only the
    // loss can become less.
    Score score(const Patch& patch, const Score& bound) {
        const bool good = bound.invalid == 0 && bound.turning_points == 0;
        return judge_.score(state_, patch, good ? bound.loss - 1 : kAnyLoss, bound.invalid);
    }

    // ---- the operations

    // The parts of a boundary that run near facets that have changed.
    void redraw_boundary(Index b) {
        begin_band({});
        const Range r = state_.graph.boundaries[b].halfedges;
        for (Index i = r.first; i < r.last; i++) {
            const Index h = state_.graph.halfedges[i], left = mesh_.left(h), right = mesh_.right(h);
            if (!near_.has(left) && !near_.has(right)) continue;
            if (in_.insert(left)) band_.push_back(left);
            if (in_.insert(right)) band_.push_back(right);
        }
        if (band_.empty()) return;
        Step step{"redraw-boundary", b, false, false, 0, 0, state_.score, state_.score};
        for (const int rings : kBandRings) {
            widen_band(rings);
            for (const int compactness : kBandCompactness) {
                const Proposals proposals = redraw_(state_, band_, compactness);
                for (std::size_t i = 0; i < proposals.size(); i++)
                    if (attempt(proposals[i], step) && i == 0) break;   // the whole, so no parts
            }
        }
        finish(step);
    }

    // The connected facets around f that point away from their label take another one, alone, with one or two of the facets
    // that touch them, or with all of these up to two rings: which one, and with which, is tried.
    void turn(Index f) {
        std::vector<Index> away = {f};
        in_.clear(mesh_.facets());
        in_.insert(f);
        for (std::size_t i = 0; i < away.size(); i++)
            for (Index h = 3 * away[i]; h < 3 * away[i] + 3; h++)
                if (points_away(mesh_.right(h)) && in_.insert(mesh_.right(h))) away.push_back(mesh_.right(h));
        for (const Index g : away) turned_.insert(g);
        Step step{"turn-facets", f, false, false, 0, 0, state_.score, state_.score};
        Patch best;
        const auto try_facets = [&](const std::vector<Index>& facets) {
            for (Label l = 0; l < kLabels && !over(); l++) {
                const Score found = score(relabel(facets, l), step.after);
                step.proposals++;
                proposals_tried_++;
                if (!(found < step.after) || judge_.added_charts() > 0) continue;
                step.after = found;
                best = relabel(facets, l);
            }
        };
        begin_band(away);
        widen_band(1);
        const std::vector<Index> around = band_;   // behind those of `away`
        const std::size_t none = away.size() - 1;
        for (std::size_t i = none; i < around.size(); i++) {
            for (std::size_t k = none; k < std::max(i, none + 1); k++) {
                std::vector<Index> facets = away;
                if (i > none) facets.push_back(around[i]);
                if (k > none) facets.push_back(around[k]);
                try_facets(facets);
            }
        }
        begin_band(away);
        std::vector<Index> beside = away;   // and those that share an edge with them
        for (const Index g : away)
            for (Index h = 3 * g; h < 3 * g + 3; h++)
                if (in_.insert(mesh_.right(h))) beside.push_back(mesh_.right(h));
        try_facets(beside);
        try_facets(around);
        begin_band(around);
        widen_band(1);
        try_facets(band_);
        if (!best.empty()) {
            judge_.apply(state_, best);
            step.kept = true;
            step.facets = static_cast<Index>(best.size());
        }
        finish(step);
    }

    // The face of f, beside a lost feature edge: the facets of its chart up to feature edges. It takes the label that wins most,
    // if that makes no new chart, wins feature edges worth twice the fidelity that it costs, and turns no facet across its label:
    // a polycube would sweep such a face sideways, which costs more than the edges.
    void relabel_face(Index f) {
        if (face_tried_.has(f)) return;
        const Label old = state_.labels[f];
        std::vector<Index> face = {f};
        in_.clear(mesh_.facets());
        in_.insert(f);
        for (std::size_t i = 0; i < face.size(); i++)
            for (Index h = 3 * face[i]; h < 3 * face[i] + 3; h++)
                if (!mesh_.feature[h] && !state_.graph.is_border(h) && in_.insert(mesh_.right(h))) face.push_back(mesh_.right(h));
        for (const Index g : face) face_tried_.insert(g);
        Step step{"relabel-face", f, false, false, 0, 0, state_.score, state_.score};
        if (over() || !tried_.insert(fingerprint(relabel(face, old))).second) return;
        Label best = old;
        for (Label l = 0; l < kLabels; l++) {
            if (l == old || std::any_of(face.begin(), face.end(), [&](Index g) { return along(mesh_.normal[g], l) < kAcross; }))
                continue;
            step.proposals++;
            proposals_tried_++;
            const Score found = score(relabel(face, l), step.after);
            if (!(found < step.after) || judge_.added_charts() > 0) continue;
            std::int64_t cost = 0;
            for (const Index g : face) cost += judge_.loss(g, l) - judge_.loss(g, old);
            if (found.invalid == step.before.invalid && found.turning_points == step.before.turning_points &&
                step.before.loss - found.loss < cost)
                continue;
            best = l;
            step.after = found;
        }
        if (best != old) {
            judge_.apply(state_, relabel(face, best));
            face_tried_.clear(mesh_.facets());
            step.kept = true;
            step.facets = static_cast<Index>(face.size());
        }
        finish(step);
    }

    // Keeps the patch if the score improves and no chart is added. What was refused is not tried again on the same labels there.
    bool attempt(const Patch& patch, Step& step) {
        if (over() || !tried_.insert(fingerprint(patch)).second) return false;
        step.proposals++;
        proposals_tried_++;
        if (!(score(patch, state_.score) < state_.score) || judge_.added_charts() > 0) return false;
        judge_.apply(state_, patch);
        step.kept = true;
        step.facets += static_cast<Index>(patch.size());
        step.after = state_.score;
        return true;
    }
    void finish(const Step& step) const {
        if (options_.trace && step.proposals > 0) options_.trace(step);
    }

    // Of the patch and the labels on and around it.
    std::uint64_t fingerprint(const Patch& patch) const {
        Fingerprint print;
        for (const Relabel& r : patch) {
            print.mix(r.facet);
            print.mix(r.label);
            print.mix(state_.labels[r.facet]);
            for (Index h = 3 * r.facet; h < 3 * r.facet + 3; h++) print.mix(state_.labels[mesh_.right(h)]);
        }
        return print.value();
    }

    const TriMesh& mesh_;
    const RoutineOptions& options_;
    Judge judge_;
    Redraw redraw_;
    State state_;
    Index proposals_tried_ = 0;
    std::set<std::uint64_t> tried_;
    std::vector<Index> features_;   // half-edges; those inside charts are lost
    Marks near_, in_, turned_, touched_;
    std::vector<Index> band_;
    std::size_t inner_ = 0;   // so many facets of the band have all that touch them in it
    Marks face_tried_;        // the faces tried since something has changed
};

}   // namespace

State polish(const TriMesh& mesh, const Labeling& start, State state, const RoutineOptions& options) {
    return Polish(mesh, std::move(state), options).run(start);
}

}   // namespace polylab
