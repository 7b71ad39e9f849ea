//! Channels on curved screens or behind a projector's lens: drawn as flat pictures, in which every pixel looks up its
//! place.

use crate::facet::{Facet, SurfaceGrid, facets};
use bytemuck::bytes_of;
use glam::{DVec2, DVec3, Vec4};
use rayon::prelude::*;
use render::display::Pass;
use render::target::{Format, Radiance, texture};
use render::{Gpu, view_from_rows};
use room::{Channel, Display};
use wgpu::util::DeviceExt;

/// Cells along each side of the grid by which facets are chosen.
const GRID: usize = 48;

/// Map from a viewport's pixels to points of the room, and the flat pictures seen in these directions.
pub struct Curved {
    points: wgpu::TextureView,
    grid: SurfaceGrid,
    /// Flat pictures and the targets they are drawn into.
    pub facets: Vec<(Facet, Radiance)>,
    /// Picture that the channel shows.
    pub shown: wgpu::TextureView,
    size: [u32; 2],
}

impl Curved {
    /// Creates the map of a channel. The points of its pixels do not depend on the eye and are computed only once.
    pub fn new(gpu: &Gpu, display: &Display, channel: &Channel, format: Format) -> Self {
        let size @ [width, height] = channel.size();
        let texel = |point: Option<DVec3>| point.map_or([0.0; 4], |point| point.as_vec3().extend(1.0).to_array());
        let texels: Vec<[f32; 4]> = channel.points(display, size).into_iter().map(texel).collect();
        let (format_of_points, bytes) = (wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels));
        let points = view_from_rows(gpu, "points", [width, height, 1], format_of_points, bytes);

        let at = |index: usize| (index as f64 / GRID as f64).clamp(1e-9, 1.0 - 1e-9);
        let place = |index: usize| channel.point(display, DVec2::new(at(index % (GRID + 1)), at(index / (GRID + 1))));
        let grid = SurfaceGrid {
            size: [GRID + 1; 2],
            points: (0..(GRID + 1) * (GRID + 1)).into_par_iter().map(place).collect(),
            pixels: DVec2::new(f64::from(width), f64::from(height)) / GRID as f64,
        };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            points,
            grid,
            facets: Vec::new(),
            shown: texture(gpu, "shown on a surface", size, format.colour, 1, usage),
            size,
        }
    }

    /// Chooses facets for an eye in the room. Textures of the previous facets are kept where their size fits.
    pub fn look_from(&mut self, gpu: &Gpu, eye: DVec3, density: f64, format: Format) {
        let largest = gpu.device.limits().max_texture_dimension_2d.min(8192);
        let mut before: Vec<_> = self.facets.drain(..).map(|(_, target)| target).collect();
        for facet in facets(&self.grid, eye, density, largest) {
            let fits = before.iter().position(|target| target.size == facet.size);
            let target = fits.map_or_else(|| Radiance::new(gpu, facet.size, format), |index| before.swap_remove(index));
            self.facets.push((facet, target));
        }
    }

    /// Resamples the facets into the channel's picture.
    pub fn resample(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, pass: &Pass, eye: DVec3) {
        let [width, height] = self.size;
        for (number, (facet, target)) in self.facets.iter().enumerate() {
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
            pass.draw_part(gpu, encoder, &self.shown, &resources, [0, 0, width, height], number > 0);
        }
    }
}
