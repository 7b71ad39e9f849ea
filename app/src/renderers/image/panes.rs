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
    /// Unit vector through the picture's middle, cube's axes.
    forward: DVec3,
    /// Inward unit normals of the picture's edges, cube's axes.
    edges: [DVec3; 4],
    /// Angle from the middle to a corner.
    corner_rad: f64,
    /// The largest angle from the motion to anything in the picture.
    furthest_rad: f64,
    /// Pixels per tangent in the middle of the picture.
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
    Pane(Part, u32),
    Cut(DVec2, Box<[Tree; 4]>),
}

/// A part that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    part: Part,
    /// Texels along each side, without the margin.
    pub side: u32,
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

/// A circle of directions and all within it.
#[derive(Clone, Copy, Debug)]
struct Cap {
    middle: DVec3,
    /// In the observer's frame, up to π.
    radius_rad: f64,
    /// The largest angle of anything in it from the motion, up to π.
    furthest_rad: f64,
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
        let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]]
            .map(|[x, y]| forward + x * across * right + y * along * up);
        let stern_seen =
            edges_admit(&[edge(right, across), edge(-right, across), edge(up, along), edge(-up, along)], DVec3::NEG_Z);
        // Away from the stern, what is furthest from the motion lies on the picture's border: bounded by the corners' circle.
        let corner_rad = angle(forward, corners[0]);
        let furthest = (angle(forward, motion) + corner_rad).min(std::f64::consts::PI);
        Self {
            cube_from_world,
            forward: cube_from_world * forward,
            edges: [edge(right, across), edge(-right, across), edge(up, along), edge(-up, along)],
            corner_rad,
            furthest_rad: if stern_seen { std::f64::consts::PI } else { furthest },
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
            furthest_rad: near.abs().max(far.abs()).min(std::f64::consts::PI),
        }
    }

    /// Pixels per tangent of a part, at most, where the picture sees it.
    fn density(&self, part: &Part, cap: &Cap) -> f64 {
        // The picture stretches away from its middle, by 1/cos² along the radius.
        let from_middle = (angle(self.forward, cap.middle) + cap.radius_rad).min(self.corner_rad);
        let stretched = self.focal_length / from_middle.cos().powi(2);
        // Aberration enlarges angles by 1/D, most where D is least: furthest from the motion.
        let (sine, cosine) = (0.5 * cap.furthest_rad.min(self.furthest_rad)).sin_cos();
        let enlarged = self.kappa * sine * sine + cosine * cosine / self.kappa;
        // The face itself shows an angle smaller the further from its middle.
        let nearest = (part.middle.abs() - part.half).max(DVec2::ZERO);
        stretched * enlarged / (1.0 + nearest.length_squared()).sqrt()
    }

    /// Finds the cheapest panes of a part.
    fn cut(&self, part: Part, texels_per_pixel: f64, depth: u32) -> (f64, Tree) {
        let cap = self.cap(&part);
        if !self.sees(&cap) {
            return (0.0, Tree::Unseen);
        }
        let side = (texels_per_pixel * self.density(&part, &cap) * 2.0 * part.half).ceil().max(1.0);
        let whole = side * side + PANE_COST;
        if side <= SMALLEST_SIDE || depth >= DEEPEST {
            return (whole, Tree::Pane(part, side as u32));
        }
        let parts = part.quarters().map(|quarter| self.cut(quarter, texels_per_pixel, depth + 1));
        let cost: f64 = parts.iter().map(|(cost, _)| cost).sum();
        if side <= LARGEST_SIDE && whole <= cost {
            return (whole, Tree::Pane(part, side as u32));
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
            let texels: f64 = plan.placed.iter().map(|pane| f64::from(pane.side + 2 * MARGIN).powi(2)).sum();
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

/// Whether a direction lies on the inner side of all edges.
fn edges_admit(edges: &[DVec3; 4], direction: DVec3) -> bool {
    edges.iter().all(|edge| edge.dot(direction) >= 0.0)
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
    /// Texels along each side with the margin.
    pub fn drawn_side(&self) -> u32 {
        self.side + 2 * MARGIN
    }

    fn pane(&self) -> Pane {
        let Part { middle, half, .. } = self.part;
        let scale = f64::from(self.side) / (2.0 * half);
        let low = Vec2::new(self.place[0] as f32, self.place[1] as f32) + MARGIN as f32;
        Pane {
            corner: DVec2::new(middle.x - half, middle.y + half).as_vec2(),
            scale: DVec2::new(scale, -scale).as_vec2(),
            low,
            high: low + self.side as f32,
        }
    }

    /// The view that draws it, and the planes through the eye that bound what it sees: inward unit normals, world axes.
    ///
    /// Positions are relative to a point that lies `from_eye` metres from the eye (world axes).
    pub fn view(&self, cube_from_world: &DMat3, from_eye: DVec3, near_m: f64) -> (View, [DVec3; 5]) {
        let world_from_cube = cube_from_world.transpose();
        let [right, up, forward] = FACES[self.part.face].map(|axis| world_from_cube * axis);
        let half = self.part.half * f64::from(self.drawn_side()) / f64::from(self.side);
        let middle = self.part.middle;
        let row_x = (right - middle.x * forward) / half;
        let row_y = (up - middle.y * forward) / half;
        let row = |row: DVec3| row.extend(row.dot(from_eye));
        let rows = DMat4::from_cols(row(row_x), row(row_y), DVec4::new(0.0, 0.0, 0.0, near_m), row(forward));
        let pixel = 2.0 / self.drawn_side() as f32;
        let view = View {
            clip_from_observer: matrix(&rows.transpose()),
            forward: (forward + middle.x * right + middle.y * up).as_vec3().extend(0.0),
            right: (half * right).as_vec3().extend(0.0),
            up: (half * up).as_vec3().extend(0.0),
            motion: forward.as_vec3().extend(1.0),
            shift: Vec4::new(1.0, 1.0, pixel, pixel),
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
            Tree::Pane(part, side) => {
                self.placed.push(Placed { part, side, place: [0; 2] });
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

/// Places squares in rows, the largest first. Returns the size of the whole.
fn pack(placed: &mut [Placed], texels: f64, largest_side: u32) -> [u32; 2] {
    let widest = placed.iter().map(Placed::drawn_side).max().unwrap_or(1);
    let width = ((texels.sqrt() * 1.05) as u32).next_multiple_of(64).clamp(widest, largest_side.max(widest));
    let mut order: Vec<usize> = (0..placed.len()).collect();
    order.sort_by_key(|&number| std::cmp::Reverse(placed[number].side));
    let (mut x, mut y, mut row_height) = (0, 0, 0);
    for number in order {
        let side = placed[number].drawn_side();
        if x + side > width {
            (x, y) = (0, y + row_height);
            row_height = 0;
        }
        placed[number].place = [x, y];
        x += side;
        row_height = row_height.max(side);
    }
    [width, (y + row_height).max(1)]
}
