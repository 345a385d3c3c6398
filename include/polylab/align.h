// align.h: for parts in any position, the rotation that brings their own faces to lie along the axes. Not in the paper.
#pragma once

#include "polylab/mesh.h"

namespace polylab {

// Three orthogonal unit vectors, right-handed: p becomes (dot(row[0], p), dot(row[1], p), dot(row[2], p)).
struct Rotation {
    Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    Vec3 operator()(const Vec3& p) const { return {dot(row[0], p), dot(row[1], p), dot(row[2], p)}; }
};

// Of the frames spanned by two directions that many facets share, the one to which the surface lies closest: the mean over the
// area of c^8, with c the largest cosine between the normal and an axis; 1 where every face lies along an axis. The frame's
// axes get the order and the signs that turn the part least.   tie: no rotation, if no frame is better by 1e-6
// O(n log n), and at most 500 frames are judged, on facets grouped by normals.
Rotation own_frame(const TriMesh& mesh);

// Positions and normals turned; everything else stays as it is.
void rotate(TriMesh& mesh, const Rotation& rotation);

}   // namespace polylab
