//! Nearest point of a triangle in space.

use glam::DVec3;

/// Point of a triangle that is nearest to `p`.
///
/// *Equation:* the regions of corners, edges and face are told apart by signs of dot products with the edges (Ericson,
/// Real-Time Collision Detection, 5.1.5).
pub(crate) fn nearest_point([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let from_a = p - a;
    let (d1, d2) = (ab.dot(from_a), ac.dot(from_a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let from_b = p - b;
    let (d3, d4) = (ab.dot(from_b), ac.dot(from_b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let from_c = p - c;
    let (d5, d6) = (ab.dot(from_c), ac.dot(from_c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    let (towards_c, towards_b) = (d4 - d3, d5 - d6);
    if va <= 0.0 && towards_c >= 0.0 && towards_b >= 0.0 {
        return b + (c - b) * (towards_c / (towards_c + towards_b));
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

#[cfg(test)]
mod tests {
    //! Law under test: no point of the triangle is nearer than the one found, and that one is in the triangle. A wrong
    //! program lets a sphere into an edge or a corner.
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn no_point_of_the_triangle_is_nearer() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut point = || DVec3::from_array(random.random()) * 2.0 - 1.0;
        for _ in 0..2000 {
            let triangle @ [a, b, c] = [point(), point(), point()];
            let p = 2.0 * point();
            let found = nearest_point(triangle, p);
            let normal = (b - a).cross(c - a).normalize();
            assert!((found - a).dot(normal).abs() < 1e-9, "off the plane");
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                    let other = a + (b - a) * u + (c - a) * v;
                    assert!(p.distance(found) <= p.distance(other) + 1e-9, "{found} for {other}");
                    // The found point is the projection on a convex set.
                    assert!((p - found).dot(other - found) < 1e-9);
                }
            }
        }
    }
}
