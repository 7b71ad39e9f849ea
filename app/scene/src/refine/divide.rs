//! Division of a triangle at the midpoints of its edges.

/// Calls `child` with each of the triangles that one is divided into at its edges' midpoints (0–1, 1–2, 2–0). Winding
/// is kept.
///
/// A quadrilateral is cut along its shorter diagonal, which keeps the angles wide.
pub fn divide<V: Copy>(
    [a, b, c]: [V; 3],
    midpoints: [Option<V>; 3],
    distance: impl Fn(V, V) -> f64,
    mut child: impl FnMut([V; 3]),
) {
    let mut halves = |a, middle, b, c| {
        child([a, middle, c]);
        child([middle, b, c]);
    };
    match midpoints {
        [None, None, None] => return child([a, b, c]),
        [Some(p), None, None] => return halves(a, p, b, c),
        [None, Some(p), None] => return halves(b, p, c, a),
        [None, None, Some(p)] => return halves(c, p, a, b),
        _ => {}
    }
    // The split edges are a–b at p and b–c at q.
    let mut thirds = |a, p, b, q, c| {
        child([p, b, q]);
        if distance(a, q) <= distance(p, c) {
            child([a, p, q]);
            child([a, q, c]);
        } else {
            child([a, p, c]);
            child([p, q, c]);
        }
    };
    match midpoints {
        [Some(p), Some(q), None] => thirds(a, p, b, q, c),
        [None, Some(p), Some(q)] => thirds(b, p, c, q, a),
        [Some(q), None, Some(p)] => thirds(c, p, a, q, b),
        [Some(p), Some(q), Some(r)] => [[a, p, r], [p, b, q], [r, q, c], [p, q, r]].into_iter().for_each(child),
        _ => {}
    }
}
