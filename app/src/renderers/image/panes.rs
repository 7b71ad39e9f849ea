//! Which parts of the world around the eye are drawn, and how finely.
//!
//! The directions around the eye are a cube, turned so that +z is along the motion. Each face is cut in four, and the parts in four again, where
//! that saves texels: what the picture does not see is left out, and what aberration enlarges (by 1/D, astern up to 2γ) gets as
//! many texels as the picture has pixels for it. What is left are squares of very different size on the faces: panes.
//!
//! A part is judged by a cap around it. Aberration maps circles to circles (Penrose 1959), so the cap that the observer sees is known
//! exactly from two points on the meridian through the motion; it is conservative, so that no pixel looks for a pane in vain.

use crate::views::{Camera, matrix};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, IVec4, Mat4, Vec2, Vec4};
use physics::Celerity;
use shaders::{Cut, Map, Pane, View};

/// Texels that a pane's own draw call is worth: culling, state, the vertices of what crosses its edges.
const PANE_COST: f64 = 16_384.0;
/// Parts smaller than this many texels are not cut.
const SMALLEST_SIDE: f64 = 96.0;
/// Larger panes are cut in any case.
const LARGEST_SIDE: f64 = 2048.0;
/// Cuts of a part within a part: at 2⁻⁴⁸ of a face f64 ends.
const DEEPEST: u32 = 48;
/// Texels drawn around each pane, so that every texel in it has neighbours.
const MARGIN: u32 = 1;

/// What is seen: a flat picture, by an observer in motion.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// From the axes of world and observer to the cube's.
    pub cube_from_world: DMat3,
    /// Right, up and forward of the picture, cube's axes.
    picture: [DVec3; 3],
    /// Inward unit normals of the picture's edges, cube's axes.
    edges: [DVec3; 4],
    /// Pixels from the picture's middle to its right and upper edge.
    half_size: DVec2,
    /// Pixels per tangent of the picture.
    focal_length: f64,
    kappa: f64,
}

/// A square part of a cube's face.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    face: usize,
    /// Tangents of its middle.
    middle: DVec2,
    /// Tangents from its middle to its edge.
    half: f64,
}

/// What became of a part.
enum Tree {
    Unseen,
    Pane(Part, [u32; 2]),
    Cut(DVec2, Box<[Tree; 4]>),
}

/// A part that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    part: Part,
    /// Texels across and down, without the margin.
    size: [u32; 2],
    /// Texel of its upper left corner in the atlas, margin included.
    pub place: [u32; 2],
}

/// Everything that is drawn for one picture, and how its pixels find it.
pub struct Plan {
    /// What is drawn, and where.
    pub placed: Vec<Placed>,
    /// For the shader; as long as `placed`.
    pub panes: Vec<Pane>,
    /// For the shader.
    pub cuts: Vec<Cut>,
    /// For the shader.
    pub map: Map,
    /// Texels of the atlas.
    pub size: [u32; 2],
    /// Texels per pixel along each axis that were possible.
    pub texels_per_pixel: f64,
}

/// Right, up and forward of a cube's face for one who looks at it from within, cube's axes; `warp.wgsl` orders them alike.
const FACES: [[DVec3; 3]; 6] = [
    [DVec3::Y, DVec3::X, DVec3::Z],
    [DVec3::X, DVec3::Y, DVec3::NEG_Z],
    [DVec3::Z, DVec3::Y, DVec3::X],
    [DVec3::Y, DVec3::Z, DVec3::NEG_X],
    [DVec3::X, DVec3::Z, DVec3::Y],
    [DVec3::Z, DVec3::X, DVec3::NEG_Y],
];

/// A circle of directions and all within it, in the observer's frame.
#[derive(Clone, Copy, Debug)]
struct Cap {
    middle: DVec3,
    /// Up to π.
    radius_rad: f64,
}

impl Sight {
    /// What `camera` sees, of `size` pixels, in motion with `celerity`.
    pub fn new(camera: &Camera, size: [u32; 2], celerity: Celerity) -> Self {
        let axis = |eye: DVec3| camera.observer_from_eye * eye;
        let (forward, right, up) = (axis(DVec3::NEG_Z), axis(DVec3::X), axis(DVec3::Y));
        let [width, height] = size.map(f64::from);
        // Samples lie anywhere in a pixel, so the picture is taken to be one pixel wider all round.
        let focal_length = 0.5 * height / (0.5 * camera.fov_y_rad).tan();
        let (across, along) = ((0.5 * width + 1.0) / focal_length, (0.5 * height + 1.0) / focal_length);

        // The cube: z along the motion; x towards the middle of the picture, if that is another direction.
        let motion = celerity.vector().normalize_or(forward);
        let side = [forward, right, up].into_iter().map(|axis| axis - axis.dot(motion) * motion);
        let side = side.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let x = side.unwrap_or(right).normalize();
        let cube_from_world = DMat3::from_cols(x, motion.cross(x), motion).transpose();

        let edge = |sideways: DVec3, extent: f64| cube_from_world * (sideways + extent * forward).normalize();
        Self {
            cube_from_world,
            picture: [right, up, forward].map(|axis| cube_from_world * axis),
            edges: [edge(right, across), edge(-right, across), edge(up, along), edge(-up, along)],
            half_size: 0.5 * DVec2::new(width, height),
            focal_length,
            kappa: celerity.gamma() + celerity.magnitude(),
        }
    }

    /// Whether any of a cap may be in the picture.
    fn sees(&self, cap: &Cap) -> bool {
        let reach = cap.radius_rad.min(std::f64::consts::FRAC_PI_2).sin();
        self.edges.iter().all(|edge| edge.dot(cap.middle) >= -reach)
    }

    /// The cap that the observer sees around a part of the cube.
    fn cap(&self, part: &Part) -> Cap {
        let middle = part.direction(DVec2::ZERO);
        let corners = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
        let radius = corners.into_iter().map(|corner| angle(middle, part.direction(corner))).fold(0.0, f64::max);

        // Along the meridian from the motion through the middle, angles shrink as tan(θ'/2) = tan(θ/2) / κ; both ends of the cap do.
        let from_motion = f64::atan2(middle.truncate().length(), middle.z);
        let seen = |world: f64| 2.0 * f64::atan2((0.5 * world).sin(), self.kappa * (0.5 * world).cos());
        let (near, far) = (seen(from_motion - radius), seen(from_motion + radius));
        let meridian = middle.truncate().normalize_or(DVec2::X);
        let (sine, cosine) = (0.5 * (near + far)).sin_cos();
        Cap {
            middle: (meridian * sine).extend(cosine),
            radius_rad: 0.5 * (far - near),
        }
    }

    /// Where a direction of the world is in the picture, pixels from its middle; `None` if behind the eye.
    fn pixel(&self, world: DVec3) -> Option<DVec2> {
        // The boost scales the two light-cone coordinates, which nothing cancels in.
        let across = world.truncate().length_squared();
        let length = (across + world.z * world.z).sqrt();
        let big = length + world.z.abs();
        let small = across / big;
        let (ahead, behind) = if world.z >= 0.0 { (big, small) } else { (small, big) };
        let observed = world.truncate().extend(0.5 * (ahead * self.kappa - behind / self.kappa));
        let [right, up, forward] = self.picture.map(|axis| axis.dot(observed));
        (forward > 0.0).then(|| DVec2::new(right, up) * (self.focal_length / forward))
    }

    /// Pixels across and along the picture that a part takes, at most, measured along its rows and along its columns: as many texels
    /// it needs. `None` if no part of its grid is in the picture.
    fn pixels(&self, part: &Part) -> Option<DVec2> {
        const STEPS: usize = 4;
        let at = |column: usize, row: usize| {
            let place = DVec2::new(column as f64, row as f64) * (2.0 / STEPS as f64) - 1.0;
            self.pixel(part.direction(place))
        };
        let near = 1.25 * self.half_size;
        let shown = |pixel: DVec2| pixel.abs().cmple(near).all();
        let mut most = DVec2::ZERO;
        for row in 0..=STEPS {
            for column in 0..=STEPS {
                let Some(here) = at(column, row) else { continue };
                for (axis, neighbour) in [(0, [column + 1, row]), (1, [column, row + 1])] {
                    let [column, row] = neighbour;
                    if column <= STEPS
                        && row <= STEPS
                        && let Some(there) = at(column, row)
                        && (shown(here) || shown(there))
                    {
                        most[axis] = most[axis].max(here.distance(there));
                    }
                }
            }
        }
        (most.min_element() > 0.0).then_some(most * STEPS as f64)
    }

    /// Finds the cheapest panes of a part.
    fn cut(&self, part: Part, texels_per_pixel: f64, depth: u32) -> (f64, Tree) {
        let cap = self.cap(&part);
        if !self.sees(&cap) {
            return (0.0, Tree::Unseen);
        }
        let deepest = depth >= DEEPEST;
        let size = match self.pixels(&part) {
            Some(pixels) => (texels_per_pixel * pixels).ceil().max(DVec2::ONE),
            None if deepest => DVec2::ONE,
            // Seen between the grid's points, if at all: look closer.
            None => DVec2::INFINITY,
        };
        let whole = size.element_product() + PANE_COST;
        let pane = || Tree::Pane(part, [size.x as u32, size.y as u32]);
        if deepest || size.max_element() <= SMALLEST_SIDE {
            return (whole, pane());
        }
        let parts = part.quarters().map(|quarter| self.cut(quarter, texels_per_pixel, depth + 1));
        let cost: f64 = parts.iter().map(|(cost, _)| cost).sum();
        if size.max_element() <= LARGEST_SIDE && whole <= cost {
            return (whole, pane());
        }
        (cost, Tree::Cut(part.middle, Box::new(parts.map(|(_, tree)| tree))))
    }

    /// Plans the map for a picture: `texels_per_pixel` along each axis, or as many as fit into `most_texels` and `largest_side`.
    pub fn plan(&self, texels_per_pixel: f64, most_texels: f64, largest_side: u32) -> Plan {
        let mut wanted = texels_per_pixel;
        loop {
            let roots =
                [0, 1, 2, 3, 4, 5].map(|face| self.cut(Part { face, middle: DVec2::ZERO, half: 1.0 }, wanted, 0).1);
            let mut plan = Planner::default();
            let numbers = roots.map(|root| plan.number(root));
            let texels: f64 = plan.placed.iter().map(Placed::texels).sum();
            let size = pack(&mut plan.placed, texels, largest_side);
            let fits = texels <= most_texels && size[1] <= largest_side;
            if !fits && wanted > 1e-3 {
                wanted *= (most_texels / texels).sqrt().min(0.98) * 0.98;
                continue;
            }
            // A face that nobody sees is never looked up: any pane will do.
            let [ahead, astern, x, minus_x, y, minus_y] = numbers.map(|number| number.unwrap_or(-1));
            let map = Map {
                cube_from_observer: Mat4::from_mat3(self.cube_from_world.as_mat3()),
                first_roots: IVec4::new(ahead, astern, x, minus_x),
                last_roots: IVec4::new(y, minus_y, 0, 0),
            };
            let panes = plan.placed.iter().map(Placed::pane).collect();
            return Plan { placed: plan.placed, panes, cuts: plan.cuts, map, size, texels_per_pixel: wanted };
        }
    }
}

fn angle(one: DVec3, other: DVec3) -> f64 {
    f64::atan2(one.cross(other).length(), one.dot(other))
}

impl Part {
    /// Towards a place in it, −1 to 1 from left to right and from below to above; not normalised.
    fn direction(&self, place: DVec2) -> DVec3 {
        let [right, up, forward] = FACES[self.face];
        let tangent = self.middle + self.half * place;
        forward + tangent.x * right + tangent.y * up
    }

    /// Left below, right below, left above, right above.
    fn quarters(self) -> [Self; 4] {
        let half = 0.5 * self.half;
        let quarter = |x: f64, y: f64| Self { middle: self.middle + half * DVec2::new(x, y), half, ..self };
        [quarter(-1.0, -1.0), quarter(1.0, -1.0), quarter(-1.0, 1.0), quarter(1.0, 1.0)]
    }
}

impl Placed {
    /// Texels across and down with the margin.
    pub fn drawn(&self) -> [u32; 2] {
        self.size.map(|side| side + 2 * MARGIN)
    }

    /// All its texels with the margin.
    pub fn texels(&self) -> f64 {
        self.drawn().map(f64::from).iter().product()
    }

    fn pane(&self) -> Pane {
        let Part { middle, half, .. } = self.part;
        let size = DVec2::from_array(self.size.map(f64::from));
        let low = DVec2::from_array(self.place.map(f64::from)) + f64::from(MARGIN);
        Pane {
            corner: DVec2::new(middle.x - half, middle.y + half).as_vec2(),
            scale: (size / (2.0 * half) * DVec2::new(1.0, -1.0)).as_vec2(),
            low: low.as_vec2(),
            high: (low + size).as_vec2(),
        }
    }

    /// The view that draws it, and the planes through the eye that bound what it sees: inward unit normals, world axes.
    ///
    /// Positions are relative to a point that lies `from_eye` metres from the eye (world axes).
    pub fn view(&self, cube_from_world: &DMat3, from_eye: DVec3, near_m: f64) -> (View, [DVec3; 5]) {
        let world_from_cube = cube_from_world.transpose();
        let [right, up, forward] = FACES[self.part.face].map(|axis| world_from_cube * axis);
        let drawn = DVec2::from_array(self.drawn().map(f64::from));
        let half = self.part.half * drawn / DVec2::from_array(self.size.map(f64::from));
        let middle = self.part.middle;
        let row_x = (right - middle.x * forward) / half.x;
        let row_y = (up - middle.y * forward) / half.y;
        let row = |row: DVec3| row.extend(row.dot(from_eye));
        let rows = DMat4::from_cols(row(row_x), row(row_y), DVec4::new(0.0, 0.0, 0.0, near_m), row(forward));
        let pixel = (2.0 / drawn).as_vec2();
        let view = View {
            clip_from_observer: matrix(&rows.transpose()),
            forward: (forward + middle.x * right + middle.y * up).as_vec3().extend(0.0),
            right: (half.x * right).as_vec3().extend(0.0),
            up: (half.y * up).as_vec3().extend(0.0),
            motion: forward.as_vec3().extend(1.0),
            shift: Vec4::new(1.0, 1.0, pixel.x, pixel.y),
            layer: Vec4::ZERO,
        };
        let planes = [forward, row_x + forward, forward - row_x, row_y + forward, forward - row_y];
        (view, planes.map(DVec3::normalize))
    }
}

/// Gives panes and cuts their numbers.
#[derive(Default)]
struct Planner {
    placed: Vec<Placed>,
    cuts: Vec<Cut>,
}

impl Planner {
    /// A cut's number, −1 − a pane's, or nothing for what is not seen.
    fn number(&mut self, tree: Tree) -> Option<i32> {
        match tree {
            Tree::Unseen => None,
            Tree::Pane(part, size) => {
                self.placed.push(Placed { part, size, place: [0; 2] });
                Some(-(self.placed.len() as i32))
            }
            Tree::Cut(at, parts) => {
                let number = self.cuts.len();
                self.cuts.push(Cut { at: at.as_vec2(), ..Default::default() });
                let parts = parts.map(|part| self.number(part));
                // Rounding may send a pixel at an edge next door, where nothing is drawn: it takes the nearest texel of a neighbour.
                let neighbour = parts.iter().flatten().next().copied()?;
                self.cuts[number].parts = IVec4::from_array(parts.map(|part| part.unwrap_or(neighbour)));
                Some(number as i32)
            }
        }
    }
}

/// Places panes in rows, the highest first. Returns the size of the whole.
fn pack(placed: &mut [Placed], texels: f64, largest_side: u32) -> [u32; 2] {
    let widest = placed.iter().map(|pane| pane.drawn()[0]).max().unwrap_or(1);
    let width = ((texels.sqrt() * 1.05) as u32).next_multiple_of(64).clamp(widest, largest_side.max(widest));
    let mut order: Vec<usize> = (0..placed.len()).collect();
    order.sort_by_key(|&number| std::cmp::Reverse(placed[number].size[1]));
    let (mut x, mut y, mut row_height) = (0, 0, 0);
    for number in order {
        let [across, down] = placed[number].drawn();
        if x + across > width {
            (x, y) = (0, y + row_height);
            row_height = 0;
        }
        placed[number].place = [x, y];
        x += across;
        row_height = row_height.max(down);
    }
    [width, (y + row_height).max(1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn explore() {
        for beta in [0.0, 0.5, 0.8, 0.99] {
            let camera = Camera::looking(DVec3::NEG_Z, DVec3::Y, 60.0_f64.to_radians());
            let celerity = physics::Beta::new(DVec3::NEG_Z * beta).unwrap().celerity();
            let sight = Sight::new(&camera, [1280, 720], celerity);
            let started = std::time::Instant::now();
            let plan = sight.plan(1.25, 1e9, 16384);
            println!("{beta}: {} panes, {} cuts, {:.2} M texels, {:?} of {:.2} M, {:?}", plan.placed.len(), plan.cuts.len(),
              plan.placed.iter().map(Placed::texels).sum::<f64>() / 1e6, plan.size, f64::from(plan.size[0]) * f64::from(plan.size[1]) / 1e6, started.elapsed());
            for p in &plan.placed { if plan.placed.len() < 40 { println!("  {:?} {:?} {:?} half {}", p.part.face, p.size, p.part.middle, p.part.half); } }
        }
    }
}
