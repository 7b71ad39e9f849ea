//! Channels on curved screens or behind a projector's lens. Every pixel shows a point of the room. A method with a map
//! of all directions looks along its direction; others draw flat pictures, in which the pixel looks up its place.

use crate::facet::{Facet, PixelSide, SurfaceGrid, facets};
use bytemuck::bytes_of;
use glam::{DVec2, DVec3, Vec4};
use rayon::prelude::*;
use render::display::Pass;
use render::target::{Format, Radiance};
use render::{Gpu, view_from_rows};
use room::{Channel, Display};
use wgpu::util::DeviceExt;

/// Cells along each side of the grid by which facets are chosen.
const GRID: usize = 48;

/// Map from a viewport's pixels to points of the room, and the flat pictures seen in these directions.
pub struct Curved {
    /// Point of the room for each pixel that is drawn, metres.
    pub points: wgpu::TextureView,
    /// Points of all pixels, kept while fewer are drawn.
    pub whole_points: wgpu::TextureView,
    grid: SurfaceGrid,
    /// Flat pictures in which the screen is seen.
    pub facets: Vec<Facet>,
    /// Targets that flat pictures are drawn into, by number of the facet; empty while the whole picture is drawn at
    /// once.
    pub targets: Vec<Radiance>,
    /// Picture that the channel shows.
    pub shown: Radiance,
}

impl Curved {
    /// Creates the map of a channel. The points of its pixels do not depend on the eye and are computed only once.
    pub fn new(gpu: &Gpu, display: &Display, channel: &Channel, format: Format) -> Self {
        let points = points(gpu, display, channel, channel.size());
        let point = |place| channel.point(display, place);
        Self::with_points(gpu, channel.size(), points, (point, PixelSide::Mean), format)
    }

    /// Creates the map of a picture of `size` pixels from the point that each of its places shows, 0 to 1 from the
    /// upper left.
    pub fn of_places(gpu: &Gpu, size: [u32; 2], point: impl Fn(DVec2) -> Option<DVec3> + Sync, format: Format) -> Self {
        let pixels = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let of_pixel = |index: u64| {
            let at = DVec2::new((index % u64::from(size[0])) as f64, (index / u64::from(size[0])) as f64);
            point((at + 0.5) / pixels)
        };
        let all = (0..u64::from(size[0]) * u64::from(size[1])).into_par_iter().map(of_pixel).collect();
        Self::with_points(gpu, size, upload(gpu, size, all), (point, PixelSide::Longer), format)
    }

    fn with_points(
        gpu: &Gpu,
        size @ [width, height]: [u32; 2],
        points: wgpu::TextureView,
        (point, fineness): (impl Fn(DVec2) -> Option<DVec3> + Sync, PixelSide),
        format: Format,
    ) -> Self {
        let at = |index: usize| (index as f64 / GRID as f64).clamp(1e-9, 1.0 - 1e-9);
        let place = |index: usize| point(DVec2::new(at(index % (GRID + 1)), at(index / (GRID + 1))));
        let grid = SurfaceGrid {
            size: [GRID + 1; 2],
            points: (0..(GRID + 1) * (GRID + 1)).into_par_iter().map(place).collect(),
            pixels: DVec2::new(f64::from(width), f64::from(height)) / GRID as f64,
            fineness,
        };
        let shown = Radiance::new(gpu, size, format);
        Self { whole_points: points.clone(), points, grid, facets: Vec::new(), targets: Vec::new(), shown }
    }

    /// Draws with this number of pixels from now on.
    pub fn fit(&mut self, gpu: &Gpu, display: &Display, channel: &Channel, size: [u32; 2]) {
        if self.shown.size == size {
            return;
        }
        let whole = size == channel.size();
        self.points = if whole { self.whole_points.clone() } else { points(gpu, display, channel, size) };
        self.shown = Radiance::new(gpu, size, self.shown.format);
    }

    /// Chooses facets for an eye in the room. `density`: texels for each pixel of the screen, along each axis.
    pub fn look_from(&mut self, gpu: &Gpu, eye: DVec3, density: f64) {
        let largest = gpu.device.limits().max_texture_dimension_2d.min(8192);
        self.facets = facets(&self.grid, eye, density, largest);
    }

    /// Makes the targets that the facets are drawn into. Those of the picture before are kept where their size fits.
    pub fn make_targets(&mut self, gpu: &Gpu, format: Format) {
        let mut before = std::mem::take(&mut self.targets);
        for facet in &self.facets {
            let fits = before.iter().position(|target| target.size == facet.size);
            let target = fits.map_or_else(|| Radiance::new(gpu, facet.size, format), |index| before.swap_remove(index));
            self.targets.push(target);
        }
    }

    /// Resamples the facets into the channel's picture.
    pub fn resample(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, pass: &Pass, eye: DVec3) {
        let [width, height] = self.shown.size;
        for (number, (facet, target)) in self.facets.iter().zip(&self.targets).enumerate() {
            let axes = facet.room_from_facet;
            let axis = |axis: DVec3| axis.as_vec3().extend(0.0);
            let focal_length = facet.tangents.focal_length(facet.size);
            let straight = DVec2::new(-facet.tangents.low.x, facet.tangents.high.y) * focal_length;
            let uniform = shaders::FacetUniforms {
                eye: eye.as_vec3().extend(facet.limit as f32),
                right: axis(axes.x_axis),
                up: axis(axes.y_axis),
                forward: axis(-axes.z_axis),
                texel: Vec4::new(straight.x as f32, straight.y as f32, focal_length.x as f32, -focal_length.y as f32),
            };
            let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("facet"),
                contents: bytes_of(&uniform),
                usage: wgpu::BufferUsages::UNIFORM,
            });
            let resources = [
                wgpu::BindingResource::TextureView(&self.points),
                uniform.as_entire_binding(),
                wgpu::BindingResource::TextureView(target.result()),
            ];
            pass.draw_part(gpu, encoder, self.shown.result(), &resources, [0, 0, width, height], number > 0);
        }
    }
}

/// Texture of the room's points for `size` pixels spread evenly over a channel.
fn points(gpu: &Gpu, display: &Display, channel: &Channel, size: [u32; 2]) -> wgpu::TextureView {
    upload(gpu, size, channel.points(display, size))
}

/// Texture of points, row by row.
fn upload(gpu: &Gpu, [width, height]: [u32; 2], points: Vec<Option<DVec3>>) -> wgpu::TextureView {
    let texel = |point: Option<DVec3>| point.map_or([0.0; 4], |point| point.as_vec3().extend(1.0).to_array());
    let texels: Vec<[f32; 4]> = points.into_iter().map(texel).collect();
    let (format, bytes) = (wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels));
    view_from_rows(gpu, "points", [width, height, 1], format, bytes)
}
