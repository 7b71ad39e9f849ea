//! Plan of the town: the way round it, the lines of house fronts on both sides, and the lots along them.
//!
//! The way is a closed uniform cubic B-spline (continuous curvature), ridden clockwise on a map with north, −z, at
//! the top. In the streets the fronts keep their distance from it; in the market square they follow corners given by
//! hand. Lots are quadrilaterals that share their side lines, so that the rows have no gaps. Special buildings
//! replace some houses.

use glam::{DVec3, Vec2, Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Control points of the way: x, z, and the distance of the house fronts to its left and to its right, metres.
const WAY: [[f32; 4]; 24] = [
    [4.5, 6.0, 3.4, 3.4],
    [4.0, -8.0, 3.4, 3.4],
    [2.0, -22.0, 3.6, 3.6],
    [0.5, -36.0, 3.4, 3.2],
    [6.0, -50.0, 2.9, 3.0],
    [21.0, -61.0, 3.2, 3.3],
    [38.0, -62.0, 3.6, 3.0],
    [54.0, -57.0, 3.0, 3.2],
    [71.0, -60.0, 2.9, 3.4],
    [88.0, -67.0, 3.3, 3.1],
    [105.0, -61.0, 3.4, 3.0],
    [114.0, -45.0, 3.0, 2.9],
    [111.0, -28.0, 3.0, 3.0],
    [105.0, -12.0, 3.1, 3.1],
    [109.0, 5.0, 3.5, 3.4],
    [119.0, 20.0, 3.1, 3.6],
    [119.0, 38.0, 2.9, 3.2],
    [107.0, 52.0, 3.2, 3.0],
    [89.0, 56.0, 3.6, 2.9],
    [72.0, 49.0, 3.1, 3.2],
    [55.0, 46.0, 2.9, 3.6],
    [38.0, 53.0, 3.1, 3.2],
    [20.0, 53.0, 3.0, 3.0],
    [8.0, 40.0, 3.3, 3.2],
];

/// Distance between points of the way, metres.
const STEP: f32 = 1.5;

/// West, east, north and south sides of the market square, metres.
pub(super) const SQUARE: [f32; 4] = [-24.0, 20.0, -24.0, 26.0];
/// North and south ends of the town hall's front, on the west side of the square, metres.
pub(super) const TOWN_HALL: [f32; 2] = [-12.0, 12.0];
/// North and south ends of the church's front, on the east side of the square, metres.
pub(super) const CHURCH: [f32; 2] = [-11.0, 11.0];
/// Place where the way passes under the gate tower, and length of the way under it, metres.
const GATE: Vec2 = vec2(106.5, -14.0);
pub(super) const GATE_DEPTH: f32 = 6.0;

/// Station: a point of the way with its surroundings.
#[derive(Clone, Copy)]
pub(super) struct Station {
    pub(super) at: Vec2,
    /// Direction of travel, unit vector.
    pub(super) ahead: Vec2,
    /// Distance of the house fronts to the left and right, metres.
    pub(super) width: [f32; 2],
}

impl Station {
    /// Point beside the way, `right` metres to its right.
    pub(super) fn beside(&self, right: f32) -> Vec2 {
        self.at + vec2(-self.ahead.y, self.ahead.x) * right
    }
}

/// Building on a lot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Use {
    House,
    TownHall,
    Church,
    Gate,
}

/// Lot: a piece of ground along the street.
#[derive(Clone, Debug)]
pub(super) struct Lot {
    /// Left and right ends of its front, as seen from the street.
    pub(super) front: [Vec2; 2],
    /// Directions in which the left and right sides run back, per metre of depth.
    pub(super) sides: [Vec2; 2],
    pub(super) kind: Use,
    pub(super) district: &'static str,
    /// True if the lot lies at the market square.
    pub(super) at_square: bool,
}

/// Plan of the whole town.
pub(super) struct TownPlan {
    /// Stations of the way, which is closed: the last one is followed by the first.
    pub(super) way: Vec<Station>,
    /// Stations at which the way leaves the square and comes back to it.
    pub(super) street: [usize; 2],
    /// Stations between which the gate stands.
    pub(super) gate: [usize; 2],
    /// Lots on the outer side (left of the way) and around the inner block (right), in the order of house numbers.
    pub(super) rows: [Vec<Lot>; 2],
}

/// Height of the ground, metres: flat round the square, rising gently to the east.
pub(super) fn ground(p: Vec2) -> f32 {
    let t = ((p.x - 26.0) / 90.0).clamp(0.0, 1.0);
    2.0 * t * t * (3.0 - 2.0 * t)
}

/// Point on the ground.
pub(super) fn on_ground(p: Vec2) -> Vec3 {
    vec3(p.x, ground(p), p.y)
}

impl TownPlan {
    pub(super) fn new(dice: &mut ChaCha8Rng) -> Self {
        let way = way();
        let crossing = |north: bool| {
            let line = if north { SQUARE[2] } else { SQUARE[3] };
            let half = way.len() / 2;
            let stations = if north { 0..half } else { half..way.len() };
            stations.min_by(|&a, &b| {
                let miss = |k: usize| (way[k].at.y - line).abs();
                miss(a).total_cmp(&miss(b))
            })
        };
        let [leave, enter] = [true, false].map(|north| crossing(north).unwrap_or_default());
        let nearest = (0..way.len())
            .min_by(|&a, &b| way[a].at.distance_squared(GATE).total_cmp(&way[b].at.distance_squared(GATE)))
            .unwrap_or_default();
        let reach = (GATE_DEPTH / 2.0 / STEP) as usize;
        let mut plan =
            Self { way, street: [leave, enter], gate: [nearest - reach, nearest + reach], rows: [vec![], vec![]] };
        plan.rows = [plan.row(0, dice), plan.row(1, dice)];
        plan
    }

    /// Circuit that a tour follows.
    pub(super) fn circuit(&self) -> Vec<DVec3> {
        self.way.iter().map(|station| on_ground(station.at).as_dvec3()).collect()
    }

    /// Stations of the street, from the square round and back to it.
    pub(super) fn street_stations(&self) -> &[Station] {
        &self.way[self.street[0]..=self.street[1]]
    }

    /// Station in the middle of the gate.
    pub(super) fn gate_station(&self) -> Station {
        self.way[(self.gate[0] + self.gate[1]) / 2]
    }

    /// Stations with lines of pennants across the street: on both ways out of the square and before the gate.
    pub(super) fn festive_stations(&self) -> Vec<&Station> {
        let [leave, enter] = self.street;
        [leave + 3, leave + 8, leave + 13, self.gate[0] - 12, self.gate[0] - 7, enter - 13, enter - 8, enter - 3]
            .into_iter()
            .map(|k| &self.way[k])
            .collect()
    }

    /// Point of a house front beside station `k`.
    fn front(&self, side: usize, k: usize) -> Vec2 {
        let station = &self.way[k];
        station.beside(if side == 0 { -station.width[0] } else { station.width[1] })
    }

    /// Divides one side into lots.
    fn row(&self, side: usize, dice: &mut ChaCha8Rng) -> Vec<Lot> {
        let [west, east, north, south] = SQUARE;
        let [leave, enter] = self.street;
        let [gate_in, gate_out] = self.gate;
        let stretch = |from: usize, to: usize| -> Vec<Vec2> { (from..=to).map(|k| self.front(side, k)).collect() };

        // Sections of this side in the direction of travel, each with a line, a use and a district.
        let third = |part: usize| leave + (gate_in - leave) * part / 3;
        let rest = |part: usize| gate_out + (enter - gate_out) * part / 3;
        let mut sections: Vec<(Vec<Vec2>, Use, &'static str)> = vec![
            (stretch(leave, third(1)), Use::House, "north street"),
            (stretch(third(1), third(2)), Use::House, "smiths' street"),
            (stretch(third(2), gate_in), Use::House, "upper street"),
            (vec![self.front(side, gate_in), self.front(side, gate_out)], Use::Gate, "gate"),
            (stretch(gate_out, rest(1)), Use::House, "gate street"),
            (stretch(rest(1), rest(2)), Use::House, "tanners' street"),
            (stretch(rest(2), enter), Use::House, "south street"),
        ];
        let (first, last) = (self.front(side, leave), self.front(side, enter));
        let square: Vec<(Vec2, Use)> = if side == 0 {
            vec![
                (last, Use::House),
                (vec2(west, south), Use::House),
                (vec2(west, TOWN_HALL[1]), Use::TownHall),
                (vec2(west, TOWN_HALL[0]), Use::House),
                (vec2(west, north), Use::House),
                (first, Use::House),
            ]
        } else {
            vec![
                (last, Use::House),
                (vec2(east, south), Use::House),
                (vec2(east, CHURCH[1]), Use::Church),
                (vec2(east, CHURCH[0]), Use::House),
                (vec2(east, north), Use::House),
                (first, Use::House),
            ]
        };
        for pair in square.windows(2) {
            let name = match pair[0].1 {
                Use::TownHall => "town hall",
                Use::Church => "church",
                _ => "market square",
            };
            sections.push((vec![pair[0].0, pair[1].0], pair[0].1, name));
        }

        // Divide the sections into fronts; on the right the street sees them in the opposite order.
        let mut lots: Vec<Lot> = Vec::new();
        for (line, kind, district) in &sections {
            for pair in divide(line, *kind, dice).windows(2) {
                lots.push(Lot {
                    front: [pair[0], pair[1]],
                    sides: [Vec2::ZERO; 2],
                    kind: *kind,
                    district,
                    at_square: *district == "market square",
                });
            }
        }
        if side == 1 {
            lots.reverse();
            for lot in &mut lots {
                lot.front.reverse();
            }
        }

        // Party walls run back along the bisector of the fronts that meet.
        let count = lots.len();
        let back: Vec<Vec2> = lots
            .iter()
            .map(|lot| {
                let right = (lot.front[1] - lot.front[0]).normalize();
                vec2(right.y, -right.x)
            })
            .collect();
        for k in 0..count {
            let next = (k + 1) % count;
            let (a, b) = (back[k], back[next]);
            let bisector = (a + b) / (1.0 + a.dot(b)).max(0.4);
            lots[k].sides[1] = bisector;
            lots[next].sides[0] = bisector;
        }
        lots
    }
}

/// Samples the B-spline and spaces its points evenly.
fn way() -> Vec<Station> {
    const FINE: usize = 200;
    let count = WAY.len();
    let sample = |k: usize| {
        let t = (k % FINE) as f32 / FINE as f32;
        let weights = [
            (1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0,
            (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0,
            t * t * t / 6.0,
        ];
        let mut sum = [0.0; 4];
        for (offset, weight) in weights.iter().enumerate() {
            let control = WAY[(k / FINE + offset + count - 1) % count];
            for (sum, value) in sum.iter_mut().zip(control) {
                *sum += weight * value;
            }
        }
        sum
    };
    let fine: Vec<[f32; 4]> = (0..=count * FINE).map(|k| sample(k % (count * FINE))).collect();
    let place = |s: &[f32; 4]| vec2(s[0], s[1]);
    let mut along = vec![0.0];
    for pair in fine.windows(2) {
        along.push(along[along.len() - 1] + place(&pair[0]).distance(place(&pair[1])));
    }
    let total = along[along.len() - 1];
    let stations = (total / STEP).round() as usize;
    let mut way: Vec<Station> = (0..stations)
        .map(|k| {
            let wanted = total * k as f32 / stations as f32;
            let index = along.partition_point(|&s| s <= wanted) - 1;
            let s = &fine[index];
            let ahead = (place(&fine[(index + 1) % fine.len()]) - place(s)).normalize_or(Vec2::NEG_Y);
            Station { at: place(s), ahead, width: [s[2], s[3]] }
        })
        .collect();
    // Directions are computed from the neighbours, so that they belong to the points themselves.
    let places: Vec<Vec2> = way.iter().map(|station| station.at).collect();
    for (k, station) in way.iter_mut().enumerate() {
        station.ahead = (places[(k + 1) % stations] - places[(k + stations - 1) % stations]).normalize();
    }
    way
}

/// Ends of the fronts along a line: houses of six to ten metres, other buildings in one piece.
fn divide(line: &[Vec2], kind: Use, dice: &mut ChaCha8Rng) -> Vec<Vec2> {
    let (first, last) = (line[0], line[line.len() - 1]);
    let length: f32 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let count = (length / 7.8).round().max(1.0) as usize;
    if kind != Use::House || count == 1 {
        return vec![first, last];
    }
    let shares: Vec<f32> = (0..count).map(|_| dice.random_range(0.78..1.22)).collect();
    let sum: f32 = shares.iter().sum();
    let mut ends = vec![first];
    let mut wanted = 0.0;
    for share in &shares[..count - 1] {
        wanted += share / sum * length;
        let mut left = wanted;
        for pair in line.windows(2) {
            let step = pair[0].distance(pair[1]);
            if left <= step {
                ends.push(pair[0].lerp(pair[1], left / step));
                break;
            }
            left -= step;
        }
    }
    ends.push(last);
    ends
}
