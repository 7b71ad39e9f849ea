//! Picture of a scene from above, for the map: colours of the materials, shaded by slope, with short shadows.

use physics::glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;
use scene::{Mesh, Scene};

use crate::texture_mean::material_means;

/// Largest side of a plan, pixels.
const LARGEST_SIDE: u32 = 1024;
/// Room round a scene's circuit, as a share of its larger side.
const ROUND_CIRCUIT: f64 = 0.4;
/// Rows of a band, the work of one thread at a time.
const BAND: usize = 64;
/// Opacity below which a surface is not drawn.
const LEAST_OPACITY: f32 = 0.35;
/// Direction to the light of the plan, x, up, z: from the north-west, as maps have it.
const TO_LIGHT: Vec3 = Vec3::new(-0.45, 0.75, -0.48);
/// Longest shadow, pixels.
const SHADOW: usize = 10;

/// Rectangle of the world in plan: x to the east, z to the south, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanArea {
    /// North-western corner, (x, z).
    pub least: DVec2,
    /// South-eastern corner, (x, z).
    pub most: DVec2,
}

impl PlanArea {
    /// Middle of the rectangle.
    pub fn middle(&self) -> DVec2 {
        0.5 * (self.least + self.most)
    }

    /// Half the size of the rectangle.
    pub fn half(&self) -> DVec2 {
        0.5 * (self.most - self.least)
    }

    /// Rectangle of a scene that is worth a plan: round its circuit, if it has one, else of its solid meshes at rest.
    /// `None` for a scene without any.
    pub fn of(scene: &Scene) -> Option<Self> {
        let circuit = scene.circuit.iter().copied();
        let resting = scene.meshes.iter().filter(|mesh| mesh.solid && mesh.motion.is_none());
        let corners = resting.flat_map(|mesh| &mesh.positions).filter(|position| position.is_finite());
        let solid = bounds(corners.map(|position| scene.origin + position.as_dvec3()))?;
        let Some(route) = bounds(circuit.filter(|corner| corner.is_finite())) else { return Some(solid) };
        let room = ROUND_CIRCUIT * (route.most - route.least).max_element();
        let least = (route.least - room).max(solid.least);
        let most = (route.most + room).min(solid.most);
        Some(if least.cmplt(most).all() { Self { least, most } } else { solid })
    }
}

/// Rectangle in plan round some places.
fn bounds(places: impl Iterator<Item = DVec3>) -> Option<PlanArea> {
    let plan = |place: DVec3| DVec2::new(place.x, place.z);
    let areas = places.map(|place| PlanArea { least: plan(place), most: plan(place) });
    let all = areas.reduce(|a, b| PlanArea { least: a.least.min(b.least), most: a.most.max(b.most) })?;
    all.least.cmplt(all.most).all().then_some(all)
}

/// Picture of a scene from above: x to the right, z downward.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanPicture {
    /// Part of the world that it shows.
    pub area: PlanArea,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Pixels, rows from the top: sRGB and opacity, four bytes each; transparent where nothing is.
    pub rgba: Vec<u8>,
}

impl PlanPicture {
    /// Draws the plan of a scene at rest with at most `side` pixels a side (1024 at most): every surface at its
    /// greatest height, once, in time linear in the triangles. `None` for a scene that has no plan.
    pub fn draw(scene: &Scene, side: u32) -> Option<Self> {
        let area = PlanArea::of(scene)?;
        let side = side.clamp(1, LARGEST_SIDE);
        let extent = 2.0 * area.half();
        let pixels_per_m = f64::from(side) / extent.max_element();
        let pixels = |metres: f64| ((metres * pixels_per_m).round() as u32).clamp(1, side);
        let size = [pixels(extent.x), pixels(extent.y)];
        let sheet = PlanSheet::new(scene, area, pixels_per_m as f32);

        let [width, height] = size.map(|pixels| pixels as usize);
        let mut texels = vec![PlanTexel::EMPTY; width * height];
        texels.par_chunks_mut(width * BAND).enumerate().for_each(|(band, texels)| {
            let first = band * BAND;
            sheet.meshes.iter().for_each(|mesh| mesh.fill(&sheet, texels, width, first));
        });
        let pixels_per_m = pixels_per_m as f32;
        let rgba: Vec<u8> = (0..width * height)
            .into_par_iter()
            .flat_map_iter(|index| shaded(&texels, width, index, pixels_per_m))
            .collect();
        Some(Self { area, size, rgba })
    }
}

/// Highest surface below a pixel.
#[derive(Clone, Copy)]
struct PlanTexel {
    height: f32,
    colour: Vec3,
}

impl PlanTexel {
    const EMPTY: Self = Self { height: f32::NEG_INFINITY, colour: Vec3::ZERO };
}

/// Scene on the sheet of its plan.
struct PlanSheet<'a> {
    meshes: Vec<PlanMesh<'a>>,
    /// North-western corner relative to the scene's origin.
    corner: Vec3,
    pixels_per_m: f32,
}

/// Mesh of a plan, with the rows that it may touch.
struct PlanMesh<'a> {
    mesh: &'a Mesh,
    colour: [f32; 4],
    /// Least and greatest row.
    rows: [f32; 2],
}

impl<'a> PlanSheet<'a> {
    fn new(scene: &'a Scene, area: PlanArea, pixels_per_m: f32) -> Self {
        let means = material_means(scene);
        let corner = (DVec3::new(area.least.x, 0.0, area.least.y) - scene.origin).as_vec3();
        let row = |position: &Vec3| (position.z - corner.z) * pixels_per_m;
        let resting = scene.meshes.iter().filter(|mesh| mesh.motion.is_none());
        let plan_mesh = |mesh: &'a Mesh| {
            let colour = means.get(mesh.material).copied().unwrap_or([0.5, 0.5, 0.5, 1.0]);
            let rows = mesh
                .positions
                .iter()
                .map(row)
                .fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], row| [low.min(row), high.max(row)]);
            (colour[3] >= LEAST_OPACITY).then_some(PlanMesh { mesh, colour, rows })
        };
        Self { meshes: resting.filter_map(plan_mesh).collect(), corner, pixels_per_m }
    }
}

impl PlanMesh<'_> {
    /// Draws the mesh into the rows from `first` on.
    fn fill(&self, sheet: &PlanSheet<'_>, texels: &mut [PlanTexel], width: usize, first: usize) {
        let rows = texels.len() / width;
        let (top, bottom) = (first as f32, (first + rows) as f32);
        if self.rows[1] < top || self.rows[0] > bottom {
            return;
        }
        let positions = &self.mesh.positions;
        for triangle in self.mesh.indices.as_chunks::<3>().0 {
            let [Some(a), Some(b), Some(c)] = triangle.map(|corner| positions.get(corner as usize)) else { continue };
            let on_sheet = |corner: &Vec3| {
                let from_corner = (*corner - sheet.corner) * sheet.pixels_per_m;
                Vec3::new(from_corner.x, corner.y, from_corner.z - top)
            };
            let [a, b, c] = [a, b, c].map(on_sheet);
            let double_area = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
            if !(double_area.abs() > 1e-6 && double_area.is_finite()) {
                continue;
            }
            let range = |low: f32, high: f32, end: usize| {
                let from = (low - 0.5).ceil().max(0.0);
                let to = (high - 0.5).floor().min(end as f32 - 1.0);
                if to >= from { from as usize..to as usize + 1 } else { 0..0 }
            };
            let across = range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), width);
            let down = range(a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z), rows);
            if across.is_empty() || down.is_empty() {
                continue;
            }
            let colour = self.lit(triangle, [a, b, c], sheet.pixels_per_m);
            for row in down {
                let z = row as f32 + 0.5;
                for column in across.clone() {
                    let x = column as f32 + 0.5;
                    let weight = |p: Vec3, q: Vec3| ((q.x - p.x) * (z - p.z) - (q.z - p.z) * (x - p.x)) / double_area;
                    let (of_c, of_a) = (weight(a, b), weight(b, c));
                    let of_b = 1.0 - of_a - of_c;
                    if of_a < 0.0 || of_b < 0.0 || of_c < 0.0 {
                        continue;
                    }
                    let height = of_a * a.y + of_b * b.y + of_c * c.y;
                    let texel = &mut texels[row * width + column];
                    if height > texel.height {
                        *texel = PlanTexel { height, colour };
                    }
                }
            }
        }
    }

    /// Colour of a triangle in the light of the plan.
    fn lit(&self, triangle: &[u32; 3], corners: [Vec3; 3], pixels_per_m: f32) -> Vec3 {
        let [a, b, c] = corners.map(|corner| Vec3::new(corner.x, corner.y * pixels_per_m, corner.z));
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
        let normal = if normal.y < 0.0 { -normal } else { normal };
        let light = 0.45 + 0.75 * normal.dot(TO_LIGHT.normalize()).max(0.0);
        let [red, green, blue, _] = self.colour;
        let of_vertices = triangle.iter().map(|&vertex| {
            let [red, green, blue, _] = self.mesh.colour(vertex as usize);
            Vec3::new(red, green, blue)
        });
        Vec3::new(red, green, blue) * of_vertices.sum::<Vec3>() / 3.0 * light
    }
}

/// Pixel with the shadow of what is higher towards the light.
fn shaded(texels: &[PlanTexel], width: usize, index: usize, pixels_per_m: f32) -> [u8; 4] {
    let texel = &texels[index];
    if texel.height == f32::NEG_INFINITY {
        return [0; 4];
    }
    let (column, row) = (index % width, index / width);
    // Height of the light's ray over the pixel, for each pixel of the diagonal to the north-west.
    let rise_m = std::f32::consts::SQRT_2 / pixels_per_m * TO_LIGHT.y / TO_LIGHT.x.hypot(TO_LIGHT.z);
    let longest = SHADOW.min(column).min(row);
    let is_shaded = (1..=longest).any(|step| {
        let towards = &texels[index - step * (width + 1)];
        towards.height > texel.height + rise_m * step as f32 + 0.2
    });
    let colour = texel.colour * if is_shaded { 0.45 } else { 1.0 };
    let [red, green, blue] = colour.to_array().map(encoded);
    [red, green, blue, 255]
}

/// 8-bit sRGB value of a linear one.
fn encoded(value: f32) -> u8 {
    let value = value.clamp(0.0, 1.0);
    let coded = if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
    (coded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    //! Law: the plan shows the highest surface at its place, in its colour, and nothing where there is nothing. A wrong
    //! program mirrors the town, or draws the street over the roofs.

    use super::*;
    use physics::glam::Vec3;
    use scene::Material;

    /// Square of `side` metres in plan with its middle at (x, z), at a height.
    fn square(material: usize, [x, y, z]: [f32; 3], side: f32) -> Mesh {
        let corner = |right: f32, back: f32| Vec3::new(x + right * side / 2.0, y, z + back * side / 2.0);
        Mesh {
            material,
            positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            normals: vec![Vec3::Y; 4],
            indices: vec![0, 2, 1, 0, 3, 2],
            solid: true,
            ..Mesh::default()
        }
    }

    fn painted(colour: [f32; 3]) -> Material {
        Material { base_colour: [colour[0], colour[1], colour[2], 1.0], ..Material::default() }
    }

    fn scene(meshes: Vec<Mesh>) -> Scene {
        let materials = vec![painted([0.0, 0.5, 0.0]), painted([0.8, 0.0, 0.0])];
        Scene { origin: DVec3::new(1e7, 0.0, -1e7), materials, meshes, ..Scene::default() }
    }

    fn pixel(plan: &PlanPicture, x: f64, z: f64) -> [u8; 4] {
        let at = (DVec2::new(x, z) + DVec2::new(1e7, -1e7) - plan.area.least) / (2.0 * plan.area.half());
        let [column, row] = [at.x * f64::from(plan.size[0]), at.y * f64::from(plan.size[1])].map(|at| at as usize);
        plan.rgba[4 * (row * plan.size[0] as usize + column)..][..4].try_into().unwrap()
    }

    #[test]
    fn the_highest_surface_is_seen_where_it_is() {
        // A lawn of 40 m with a red roof in the north-east, listed first.
        let plan = PlanPicture::draw(&scene(vec![square(1, [10.0, 6.0, -10.0], 8.0), square(0, [0.0; 3], 40.0)]), 200);
        let plan = plan.unwrap();
        assert_eq!(plan.size, [200, 200]);
        let (roof, lawn) = (pixel(&plan, 10.0, -10.0), pixel(&plan, -10.0, 10.0));
        assert!(roof[0] > 200 && roof[1] == 0 && lawn[0] == 0 && lawn[1] > 150, "{roof:?} {lawn:?}");
        assert_eq!(pixel(&plan, -10.0, -10.0), lawn);
        // The roof's shadow falls to the south-east.
        assert!(pixel(&plan, 14.3, -5.7)[1] < lawn[1], "no shadow");
    }

    #[test]
    fn where_nothing_is_the_plan_is_transparent() {
        let plan = PlanPicture::draw(&scene(vec![square(0, [0.0; 3], 10.0), square(0, [40.0, 0.0, 40.0], 10.0)]), 100);
        let plan = plan.unwrap();
        assert_eq!(pixel(&plan, 20.0, 20.0), [0; 4]);
        assert_eq!(pixel(&plan, 40.0, 40.0)[3], 255);
    }

    #[test]
    fn a_scene_without_ground_has_no_plan() {
        assert_eq!(PlanPicture::draw(&scene(Vec::new()), 100), None);
        let mut broken = square(0, [0.0; 3], 10.0);
        broken.positions[0] = Vec3::NAN;
        broken.indices.push(99);
        broken.indices.extend([1, 2]);
        assert!(PlanPicture::draw(&scene(vec![broken]), 100).is_some());
    }
}
