//! Plan of the map: the parts of the world around the eye that are drawn, and the resolution of each.
//!
//! Each face of a cube around the eye is cut in four, and the parts in four again, if that saves texels. Parts that
//! the picture does not see are left out. Parts that aberration enlarges (by 1/D, astern up to 2γ) get as many texels
//! as the picture has pixels for them. The result is windows of very different size on the faces, called panes.

use super::picture_map::{CubePart, Extent, FACES, PictureMap};
use crate::view_matrix::matrix;
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Mat4, Vec4};
use shaders::{AtlasTile, MapUniforms, ViewUniforms};
use view::Sides;

/// Side up to which parts are not cut, texels.
const SMALLEST_SIDE: f64 = 24.0;
/// Side above which panes are cut in any case, texels.
const LARGEST_SIDE: f64 = 2048.0;
/// Largest ratio of the greatest enlargement of a part to its mean, if the mean counts.
const UNEVEN: f64 = 1.5;
/// Largest ratio of the greatest enlargement to the mean for a part that is not worth cutting.
const EVEN: f64 = 1.1;
/// Greatest depth of cuts within cuts: 2⁻⁴⁸ of a face is near the limit of f64.
const DEEPEST: u32 = 48;
/// Width of the border drawn around each pane, texels, so that every texel in it has neighbours.
const MARGIN: u32 = 1;

/// Resolution and cost settings of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Texels for each pixel of the picture, along each axis.
    pub texels_per_pixel: f64,
    /// True if every pixel gets that many texels, false if only the mean does.
    pub exact: bool,
    /// Fixed cost of a pane, in texels: culling, changes of state, the vertices of triangles that cross its edges.
    pub pane_cost: f64,
}

/// Result of cutting a part, with its own parts.
struct Tree {
    /// Cost of drawing the part, in texels.
    cost: f64,
    /// Window that holds everything of the part that may be seen.
    window: Window,
    kind: Kind,
}

enum Kind {
    Unseen,
    AtlasTile([u32; 2]),
    Cut(Box<[Tree; 4]>),
}

/// A rectangle on a cube's face.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Window {
    face: usize,
    /// Tangents of the lower left corner.
    low: DVec2,
    /// Tangents of the upper right corner.
    high: DVec2,
}

/// Cells of a quarter of a cube's face, or of a cell of such a quarter, row by row from the middle of the face. Each
/// value is −1 − the number of a pane, or the number of a layer.
pub type Layer = [[i32; CELLS]; CELLS];

const CELLS: usize = shaders::MAP_CELLS as usize;
const NO_PANE: Layer = [[-1; CELLS]; CELLS];

/// A window that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    window: Window,
    /// Size without the border, texels across and down.
    size: [u32; 2],
    /// Texel of the upper left corner in the atlas, border included.
    pub place: [u32; 2],
}

/// Panes that are drawn for one picture, and the tables by which its pixels find them.
pub struct Plan {
    /// Windows that are drawn, and their places in the atlas.
    pub placed: Vec<Placed>,
    /// Table of panes for the shader; as long as `placed`.
    pub panes: Vec<AtlasTile>,
    /// Table of cells for the shader, which pane is where: a layer for each quarter of a face and for each cell that
    /// is cut further.
    pub cells: Vec<Layer>,
    /// Uniform for the shader.
    pub map: MapUniforms,
    /// Size of the atlas, texels.
    pub size: [u32; 2],
    /// Texels for each pixel along each axis that were possible.
    pub texels_per_pixel: f64,
}

impl Plan {
    /// Number of texels drawn.
    pub fn texels(&self) -> f64 {
        self.placed.iter().map(Placed::texels).sum()
    }

    /// The same panes with all texels moved to the right and up by parts of a texel, at most a half: another sample of
    /// what they show.
    pub fn shifted(mut self, texels: DVec2) -> Self {
        for pane in &mut self.placed {
            let shift = texels * (pane.window.high - pane.window.low) / DVec2::from_array(pane.size.map(f64::from));
            pane.window.low += shift;
            pane.window.high += shift;
        }
        self.panes = self.placed.iter().map(Placed::pane).collect();
        self
    }
}

impl PictureMap {
    /// Finds the cheapest panes for a part.
    fn cut(&self, part: CubePart, fineness: Fineness, depth: u32) -> Tree {
        let window = part.window();
        if !self.sees(&part) {
            return Tree { cost: 0.0, window, kind: Kind::Unseen };
        }
        let extent = self.extent(&part);
        let size = extent.map(|extent| extent.texels(fineness));
        let pane = |size: DVec2, window: Window| {
            let size = (size * (window.high - window.low) / (2.0 * part.half)).ceil().max(DVec2::ONE);
            let cost = size.element_product() + fineness.pane_cost;
            Tree { cost, window, kind: Kind::AtlasTile([size.x as u32, size.y as u32]) }
        };
        // Do not cut if nothing can be gained: the part is small, or all of it is seen and evenly enlarged.
        if depth >= DEEPEST {
            return pane(DVec2::ONE, window);
        }
        if let (Some(extent), Some(size)) = (extent, size)
            && (size.max_element() <= SMALLEST_SIDE
                || (extent.inside && extent.is_even() && size.max_element() <= LARGEST_SIDE))
        {
            return pane(size, window);
        }
        let parts = part.quarters().map(|quarter| self.cut(quarter, fineness, depth + 1));
        let seen = parts.iter().filter(|tree| !matches!(tree.kind, Kind::Unseen)).map(|tree| tree.window);
        let Some(window) = seen.reduce(Window::with) else {
            return Tree { cost: 0.0, window, kind: Kind::Unseen };
        };
        let cost: f64 = parts.iter().map(|tree| tree.cost).sum();
        if let Some(size) = size.filter(|size| size.max_element() <= LARGEST_SIDE) {
            let whole = pane(size, window);
            if whole.cost <= cost {
                return whole;
            }
        }
        Tree { cost, window, kind: Kind::Cut(Box::new(parts)) }
    }

    /// Plans the map for a picture, with the wanted texels for each pixel, or as many as fit into `most_texels` and
    /// `largest_side`.
    pub fn plan(&self, fineness: Fineness, most_texels: f64, largest_side: u32) -> Plan {
        let mut wanted = fineness;
        loop {
            let roots =
                [0, 1, 2, 3, 4, 5].map(|face| self.cut(CubePart { face, middle: DVec2::ZERO, half: 1.0 }, wanted, 0));
            let mut plan = Planner { placed: Vec::new(), cells: vec![NO_PANE; 4 * FACES.len()] };
            for (face, root) in roots.into_iter().enumerate() {
                plan.fill_face(face, root);
            }
            let texels: f64 = plan.placed.iter().map(Placed::texels).sum();
            let size = pack(&mut plan.placed, texels, largest_side);
            let fits = texels <= most_texels && size[1] <= largest_side;
            if !fits && wanted.texels_per_pixel > 1e-3 {
                wanted.texels_per_pixel *= (most_texels / texels).sqrt().min(0.98) * 0.98;
                continue;
            }
            let map = MapUniforms { cube_from_observer: Mat4::from_mat3(self.cube_from_world.as_mat3()) };
            let panes = plan.placed.iter().map(Placed::pane).collect();
            return Plan {
                placed: plan.placed,
                panes,
                cells: plan.cells,
                map,
                size,
                texels_per_pixel: wanted.texels_per_pixel,
            };
        }
    }
}

impl CubePart {
    fn window(&self) -> Window {
        Window { face: self.face, low: self.middle - self.half, high: self.middle + self.half }
    }
}

impl Window {
    /// The smallest window that holds both.
    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high), ..self }
    }
}

impl Extent {
    fn texels(&self, fineness: Fineness) -> DVec2 {
        let pixels = if fineness.exact { self.most } else { self.mean.max(self.most / UNEVEN) };
        (fineness.texels_per_pixel * pixels).max(DVec2::ONE)
    }

    fn is_even(&self) -> bool {
        self.most.cmple(EVEN * self.mean).all()
    }
}

impl Placed {
    /// Size with the border, texels across and down.
    pub fn drawn(&self) -> [u32; 2] {
        self.size.map(|side| side + 2 * MARGIN)
    }

    /// Number of texels, border included.
    pub fn texels(&self) -> f64 {
        self.drawn().map(f64::from).iter().product()
    }

    fn pane(&self) -> AtlasTile {
        let Window { low: left_below, high: right_above, .. } = self.window;
        let size = DVec2::from_array(self.size.map(f64::from));
        let low = DVec2::from_array(self.place.map(f64::from)) + f64::from(MARGIN);
        AtlasTile {
            corner: DVec2::new(left_below.x, right_above.y).as_vec2(),
            scale: (size / (right_above - left_below) * DVec2::new(1.0, -1.0)).as_vec2(),
            low: low.as_vec2(),
            high: (low + size).as_vec2(),
        }
    }

    /// View that draws the pane, and its sides, world axes.
    ///
    /// Positions are relative to a point `from_eye` metres from the eye (world axes).
    pub fn view(&self, cube_from_world: &DMat3, from_eye: DVec3, near_m: f64) -> (ViewUniforms, Sides) {
        let world_from_cube = cube_from_world.transpose();
        let [right, up, forward] = FACES[self.window.face].map(|axis| world_from_cube * axis);
        let drawn = DVec2::from_array(self.drawn().map(f64::from));
        let Window { low, high, .. } = self.window;
        let half = 0.5 * (high - low) * drawn / DVec2::from_array(self.size.map(f64::from));
        let middle = 0.5 * (low + high);
        let row_x = (right - middle.x * forward) / half.x;
        let row_y = (up - middle.y * forward) / half.y;
        let row = |row: DVec3| row.extend(row.dot(from_eye));
        let rows = DMat4::from_cols(row(row_x), row(row_y), DVec4::new(0.0, 0.0, 0.0, near_m), row(forward));
        let pixel = (2.0 / drawn).as_vec2();
        let view = ViewUniforms {
            clip_from_observer: matrix(&rows.transpose()),
            forward: (forward + middle.x * right + middle.y * up).as_vec3().extend(0.0),
            right: (half.x * right).as_vec3().extend(0.0),
            up: (half.y * up).as_vec3().extend(0.0),
            motion: forward.as_vec3().extend(1.0),
            shift: Vec4::new(1.0, 1.0, pixel.x, pixel.y),
            layer: Vec4::Y,
            source: Vec4::new(0.0, 0.0, -1.0, 1.0),
            eye: Vec4::ZERO,
            eye_rest: Vec4::ZERO,
        };
        let sides = [row_x + forward, forward - row_x, row_y + forward, forward - row_y];
        (view, Sides(sides.map(DVec3::normalize)))
    }
}

/// Numbers the panes, and fills the tables in which they are found.
struct Planner {
    placed: Vec<Placed>,
    cells: Vec<Layer>,
}

impl Planner {
    /// Fills the four quarters of a face from the result of its cuts.
    fn fill_face(&mut self, face: usize, root: Tree) {
        let layer = |quarter: usize| 4 * face + quarter;
        match root.kind {
            // Parts are in the order lower left, lower right, upper left, upper right; quarters are counted from the
            // upper right.
            Kind::Cut(parts) => {
                let nearby = -(self.placed.len() as i32) - 1;
                for (quarter, part) in [3, 2, 1, 0].into_iter().zip(*parts) {
                    self.fill(Square { layer: layer(quarter), quarter, corner: [0, 0], side: CELLS }, part, nearby);
                }
            }
            kind => {
                let number = self.pane(kind, root.window, -1);
                (0..4).for_each(|quarter| self.cells[layer(quarter)] = [[number; CELLS]; CELLS]);
            }
        }
    }

    /// Fills a square of cells from the result of the cuts there. `nearby` is the pane to show where nothing is
    /// drawn.
    ///
    /// Such cells are looked up only if rounding sends a pixel across an edge. The pixel then takes the nearest texel
    /// of a neighbour.
    fn fill(&mut self, square: Square, tree: Tree, nearby: i32) {
        let Square { layer, quarter, corner: [x, y], side } = square;
        let parts = match tree.kind {
            Kind::Cut(parts) => parts,
            kind => {
                let number = self.pane(kind, tree.window, nearby);
                self.cells[layer][y..y + side].iter_mut().for_each(|row| row[x..x + side].fill(number));
                return;
            }
        };
        // A single cell has no room for four parts, so they get a layer of their own.
        let (layer, [x, y], half) = if side == 1 {
            self.cells.push(NO_PANE);
            let below = self.cells.len() - 1;
            self.cells[layer][y][x] = below as i32;
            (below, [0, 0], CELLS / 2)
        } else {
            (layer, [x, y], side / 2)
        };
        let nearby = -(self.placed.len() as i32) - 1;
        for (part, tree) in (*parts).into_iter().enumerate() {
            // In quarters left of the middle, or below it, cells count in the opposite direction.
            let [right, above] = [0, 1].map(|axis| (part >> axis & 1) ^ (quarter >> axis & 1));
            let corner = [x + half * right, y + half * above];
            self.fill(Square { layer, quarter, corner, side: half }, tree, nearby);
        }
    }

    /// Adds a pane, and returns the value for its cells; `nearby` for a part that is not seen.
    fn pane(&mut self, kind: Kind, window: Window, nearby: i32) -> i32 {
        let Kind::AtlasTile(size) = kind else { return nearby };
        self.placed.push(Placed { window, size, place: [0; 2] });
        -(self.placed.len() as i32)
    }
}

/// A square of cells.
#[derive(Clone, Copy)]
struct Square {
    layer: usize,
    /// Quarter of the face: bit 0 is set left of the middle, bit 1 below it.
    quarter: usize,
    /// Cell nearest to the middle of the face, in its layer.
    corner: [usize; 2],
    side: usize,
}

/// Places the panes in rows, the highest first. Returns the size of the whole.
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
    //! Every pixel must find its direction in a pane, at any speed, with as many texels as promised. A plan that
    //! leaves a direction out shows a stretched neighbour there. One that is too coarse shows blocks. One that is too
    //! fine costs more with speed.

    use super::*;
    use physics::{Aberration, Celerity};
    use view::Camera;

    const SIZE: [u32; 2] = [320, 180];
    const MANY: f64 = 1e9;
    const EXACT: Fineness = Fineness { texels_per_pixel: 2.0, exact: true, pane_cost: 2e3 };

    /// Place of a pixel on the cube, face and tangents, by the method of `warp.wgsl`.
    fn on_cube(sight: &PictureMap, aberration: &Aberration, observed: DVec3) -> (usize, DVec2) {
        let (world, _) = aberration.world_from_observer(observed);
        let direction = sight.cube_from_world * world;
        let face = (0..6).max_by(|&a, &b| FACES[a][2].dot(direction).total_cmp(&FACES[b][2].dot(direction)));
        let face = face.expect("a cube has faces");
        let [right, up, forward] = FACES[face];
        (face, DVec2::new(right.dot(direction), up.dot(direction)) / forward.dot(direction))
    }

    /// Pane in which a place on the cube is looked up, if the pane contains it.
    fn find(plan: &Plan, face: usize, at: DVec2) -> Option<&Placed> {
        let side = CELLS as f64;
        let mut within = at.abs() * side;
        let mut found = 4 * face as i32 + i32::from(at.x < 0.0) + 2 * i32::from(at.y < 0.0);
        while found >= 0 {
            let cell = within.floor().clamp(DVec2::ZERO, DVec2::splat(side - 1.0));
            found = plan.cells[found as usize][cell.y as usize][cell.x as usize];
            within = (within - cell) * side;
        }
        let pane = &plan.placed[(-1 - found) as usize];
        let Window { face: of, low, high } = pane.window;
        let rounding = 1e-9;
        (of == face && (at + rounding).cmpge(low).all() && (at - rounding).cmple(high).all()).then_some(pane)
    }

    fn each_pixel(camera: &Camera, mut check: impl FnMut(DVec3, DVec3)) {
        for row in (0..SIZE[1]).step_by(3) {
            for column in (0..SIZE[0]).step_by(3) {
                let place = DVec2::new(f64::from(column), f64::from(row)) + 0.5;
                let direction = |place| (camera.observer_from_eye * camera.ahead(SIZE, place)).normalize();
                check(direction(place), direction(place + DVec2::X));
            }
        }
    }

    fn looks() -> [DVec3; 4] {
        [DVec3::NEG_Z, DVec3::Z, DVec3::X, DVec3::new(0.3, -0.5, 0.8)]
    }

    #[test]
    fn every_pixel_finds_a_pane_with_enough_texels() {
        for gamma_minus_one in [0.0, 0.15, 1.3, 70.0, 1e4, 1e6] {
            let celerity = Celerity::new(
                DVec3::new(0.1, 0.2, -1.0).normalize() * f64::sqrt(gamma_minus_one * (gamma_minus_one + 2.0)),
            );
            let celerity = celerity.expect("a finite celerity");
            let aberration = Aberration::new(celerity);
            for look in looks() {
                let camera = Camera::looking(look, DVec3::Y, 1.1);
                let sight = PictureMap::new(&[(camera, SIZE)], celerity);
                let plan = sight.plan(EXACT, MANY, 1 << 20);
                let (mut few, mut all) = (0, 0);
                each_pixel(&camera, |here, neighbour| {
                    let (face, at) = on_cube(&sight, &aberration, here);
                    let pane = find(&plan, face, at);
                    let pane = pane.expect("no pane holds a pixel");
                    let (next_face, next) = on_cube(&sight, &aberration, neighbour);
                    if next_face == face {
                        // Number of texels from a pixel to the next.
                        let scale = DVec2::from_array(pane.size.map(f64::from)) / (pane.window.high - pane.window.low);
                        all += 1;
                        few += i32::from(((next - at) * scale).length() < 0.8 * EXACT.texels_per_pixel);
                    }
                });
                assert!(few * 200 <= all, "{few} of {all} pixels looking to {look} at γ − 1 = {gamma_minus_one}");
            }
        }
    }

    #[test]
    fn a_map_hardly_grows_with_speed() {
        let mean = Fineness { texels_per_pixel: 1.0, exact: false, pane_cost: 2e3 };
        let pixels = f64::from(SIZE[0] * SIZE[1]);
        for gamma in [1.0, 1.2, 1.7, 3.0, 10.0, 100.0, 1e4] {
            let celerity = Celerity::new(DVec3::NEG_Z * f64::sqrt(gamma * gamma - 1.0)).expect("a finite celerity");
            for look in looks() {
                let plan = PictureMap::new(&[(Camera::looking(look, DVec3::Y, 1.1), SIZE)], celerity).plan(
                    mean,
                    MANY,
                    1 << 20,
                );
                let texels: f64 = plan.placed.iter().map(Placed::texels).sum();
                assert!(texels < 3.0 * pixels, "{texels} texels for {pixels} pixels at γ = {gamma} looking to {look}");
            }
        }
    }

    #[test]
    fn a_plan_keeps_to_its_limits() {
        let celerity = Celerity::new(DVec3::NEG_Z * 2.0).expect("a finite celerity");
        let sight = PictureMap::new(&[(Camera::looking(DVec3::NEG_Z, DVec3::Y, 1.1), SIZE)], celerity);
        let plan = sight.plan(EXACT, 50_000.0, 400);
        assert!(plan.placed.iter().map(Placed::texels).sum::<f64>() <= 50_000.0);
        assert!(plan.size.iter().all(|&side| side <= 400), "{:?}", plan.size);
        assert!(plan.texels_per_pixel < EXACT.texels_per_pixel);
    }

    #[test]
    fn a_picture_of_a_few_pixels_takes_a_few_panes() {
        // A careless plan would cut parts without end that are in sight but lie between the points of every grid.
        for size in [[1, 1], [640, 1], [1, 4096], [1000, 3]] {
            for gamma in [1.0, 1.7, 70.0] {
                let celerity = Celerity::new(DVec3::NEG_Z * f64::sqrt(gamma * gamma - 1.0)).expect("a finite celerity");
                for look in looks() {
                    let plan = PictureMap::new(&[(Camera::looking(look, DVec3::Y, 1.1), size)], celerity).plan(
                        EXACT,
                        MANY,
                        1 << 20,
                    );
                    let panes = plan.placed.len();
                    assert!((1..1000).contains(&panes), "{panes} panes for {size:?} pixels at γ = {gamma} to {look}");
                }
            }
        }
    }

    #[test]
    fn panes_do_not_overlap_in_the_atlas() {
        let celerity = Celerity::new(DVec3::new(1.0, 0.0, -2.0)).expect("a finite celerity");
        let plan = PictureMap::new(&[(Camera::looking(DVec3::NEG_Z, DVec3::Y, 1.5), SIZE)], celerity).plan(
            EXACT,
            MANY,
            1 << 20,
        );
        assert!(plan.placed.len() > 3);
        for (number, one) in plan.placed.iter().enumerate() {
            for other in &plan.placed[..number] {
                let apart = (0..2).any(|axis| {
                    one.place[axis] >= other.place[axis] + other.drawn()[axis]
                        || other.place[axis] >= one.place[axis] + one.drawn()[axis]
                });
                assert!(apart, "{one:?} and {other:?}");
            }
        }
    }
}
