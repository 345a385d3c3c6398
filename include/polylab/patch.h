// patch.h: new labels for some facets, and what they change in validity, found without building the new graph.
//
// Only what lies around the patch is looked at: the fans of its vertices, the boundaries that pass there, in full length
// (they may become longer, shorter, or turn elsewhere), and of a chart that the patch cuts, the facets that it takes to
// see whether it falls apart.
#pragma once

#include "polylab/marks.h"
#include "polylab/turning_points.h"

#include <vector>

namespace polylab {

// New labels for some facets: what an operator proposes. Empty: it found nothing to do. Of two labels for a facet the last
// counts.
struct Relabel {
    Index facet;
    Label label;
};
using Patch = std::vector<Relabel>;

// By how much numbers grow when a patch is applied; each may be negative.
struct Effect {
    Index charts = 0;
    Index invalid = 0;   // charts, boundaries and corners
    Index turning_points = 0;
    Index lost_features = 0;   // kept feature edges inside charts
};

// Finds effects of patches, and keeps its memory between them: about 50 bytes a facet, from the first patch on.
class EffectFinder {
public:
    explicit EffectFinder(const TriMesh& mesh) : mesh_(mesh) {}

    // labels, graph and turning belong together. Exactly the difference to build_graph() and find_turning_points() of the
    // patched labels. O(facets of the patch + boundaries that pass it + what cut charts need)
    Effect effect(const Labeling& labels, const LabelingGraph& graph, const TurningPoints& turning, const Patch& patch) {
        begin(labels, graph, turning, patch);
        return finish();
    }
    // The same in two halves, the first of which is quick: it finds the feature edges that are lost, and changes(). The second
    // gives up once more than `most_invalid` more elements are sure to be invalid: then it returns that, and the rest is not
    // right.
    Index begin(const Labeling& labels, const LabelingGraph& graph, const TurningPoints& turning, const Patch& patch);
    Effect finish(Index most_invalid = std::numeric_limits<Index>::max());
    // Of the last patch: what differs from the labels it was to change, each facet once.
    const Patch& changes() const { return changes_; }
    // Of the last patch, once it is finished: what update_graph() needs. O(n) where the charts are not the same
    void describe(GraphChange& change);

private:
    bool same_charts(std::vector<Index>& to);
    void note_changes(const Patch& patch);
    void find_zone();
    void count_features();
    void leave_old_charts();
    void leave_old_boundaries();
    void judge_corners();
    void join_pieces();
    void search_cut_chart(Index chart);
    void trace_boundaries();
    void trace(Index h);
    void judge_charts();
    void count_turns();

    Label label(Index f) const { return new_label_[f] == kNoLabel ? (*labels_)[f] : new_label_[f]; }
    bool is_border(Index h) const { return label(mesh_.left(h)) != label(mesh_.right(h)); }
    Index next_border_ccw(Index h) const;
    bool at_corner(Index border) const;
    Index root(Index piece);
    void unite(Index a, Index b) { parent_[root(a)] = root(b); }

    const TriMesh& mesh_;
    const Labeling* labels_ = nullptr;   // what the effect is found for
    const LabelingGraph* graph_ = nullptr;
    const TurningPoints* turning_ = nullptr;
    Effect effect_;

    Patch changes_;
    Labeling new_label_;        // facet -> what the patch makes of it, kNoLabel where it changes nothing
    std::vector<Index> fans_;   // one half-edge per fan that has a changed facet
    Marks in_fan_;              // half-edges that leave the vertex of such a fan
    std::vector<Index> zone_;   // the facets of these fans

    // Facets of the zone, and those that a search met, belong to pieces of new charts: connected as far as known. A piece is
    // named by the position of one of its facets in the zone.
    Marks has_piece_;
    std::vector<Index> piece_;        // facet -> piece
    std::vector<Index> parent_;       // piece -> another name for it, as in a union-find forest
    std::vector<Index> boundaries_;   // piece (root) -> boundaries of that new chart

    std::vector<Index> old_charts_;   // those with facets in the zone
    Marks met_chart_, cut_chart_;     // the same; those that lose facets
    std::vector<Index> rest_;         // by old chart: the piece of its facets that have none
    Marks met_boundary_, traced_, met_vertex_, invalid_vertex_;

    struct Traced {   // a new boundary that can turn
        Range path;   // in paths_
        int axis;
        bool closed;
    };
    std::vector<Index> paths_;   // the half-edges of the boundaries traced
    std::vector<Traced> new_boundaries_;
    std::vector<int> axes_;   // memory of judge_corners()
};

}   // namespace polylab
