//! Light of a picture in any projection, for one eye or two, joined from pictures that the renderers can draw.
//!
//! A picture for one eye is a curved screen around the eye, each of whose pixels shows a direction; a cube is six flat
//! screens. In stereo every direction of a sphere has its own pair of eyes. There the picture is drawn in upright
//! strips, as a camera with a slit takes it that turns about its axis: each strip is so narrow that the eye of its
//! middle stands for all of its columns. Domes and cubes in stereo are taken from such a sphere.

use crate::curved::Curved;
use crate::head::OccupantEye;
use crate::picture::{ChannelPicture, EyeContext};
use crate::projected_view::{ProjectedView, StereoEyes};
use crate::quality::Quality;
use crate::sphere_taker::SphereTaker;
use glam::{DMat3, DQuat, DVec2, DVec3};
use render::certainty::Certainty;
use render::display::{Developer, Pass, resample};
use render::target::texture;
use render::{Gpu, GpuError, Pending, SceneRenderer};
use room::FlatSurface;
use std::f64::consts::{PI, TAU};
use studio::SCREEN_FORMAT;
use view::{FACES, Projection, Stored};

/// Displacement in a stereo picture by the width of its strips, of what is at [`NEAR_M`], pixels at most.
const STRIP_ERROR_PIXELS: f64 = 0.5;
/// Distance of what is displaced so, metres.
const NEAR_M: f64 = 1.0;
/// Factor by which the sphere is finer than the dome or cube that is taken from it.
const FINER: f64 = 1.25;

/// Light of a picture in any projection.
pub struct ProjectedPicture {
    size: [u32; 2],
    quality: Quality,
    passes: Developer,
    resample: Pass,
    source: LightSource,
    /// Joined light of each eye; empty if it is that of a single part.
    lights: Vec<wgpu::TextureView>,
    stored: Stored,
    certainty: Certainty,
}

/// Origin of the light.
enum LightSource {
    /// Parts that the renderers draw, and the eyes that see them.
    Parts(Vec<ProjectedPart>, Vec<EyeGroup>),
    /// Sphere in stereo, and the pass that takes the picture from it.
    Sphere(Box<ProjectedPicture>, Box<SphereTaker>),
}

/// Picture that the renderers draw.
struct ProjectedPart {
    picture: ChannelPicture,
    size: [u32; 2],
    screen: PartScreen,
}

/// Surface that a part shows.
enum PartScreen {
    /// Sphere around the eye.
    Round,
    /// Face of a cube around the eye, axes of the face.
    Face(FlatSurface),
    /// Wall at a distance of the head, metres, as high as the field of view.
    Wall(f64),
}

/// Parts that are seen from one place.
struct EyeGroup {
    /// Number of the eye's light.
    light: usize,
    /// Place of the eye from the head's middle, axes of the picture's middle, metres.
    from_m: DVec3,
    places: Vec<PartPlace>,
}

/// Place of a part in the whole picture.
struct PartPlace {
    /// Number of the part.
    part: usize,
    /// Upper left corner, pixels.
    corner: [u32; 2],
    /// Rotation from the part's axes to those of the picture's middle.
    eye_from_part: DMat3,
}

impl ProjectedPicture {
    /// Targets for pictures of `size` pixels for each eye.
    pub fn new(
        gpu: &Gpu,
        projection: Projection,
        size: [u32; 2],
        stereo: Option<StereoEyes>,
        quality: Quality,
    ) -> Self {
        let colour = quality.format.colour;
        let passes = Developer::new(gpu, colour, SCREEN_FORMAT);
        let source = match stereo.filter(|_| matches!(projection, Projection::Fisheye { .. } | Projection::Cube)) {
            Some(eyes) => {
                let largest = gpu.device.limits().max_texture_dimension_2d;
                let width = (sphere_width(projection, size).ceil() as u32).next_multiple_of(2).min(largest / 2 * 2);
                let sphere = Self::new(gpu, Projection::Sphere, [width, width / 2], stereo, quality);
                let taker = SphereTaker::new(gpu, projection, size, eyes.upright, sphere.lights[0].texture().format());
                LightSource::Sphere(Box::new(sphere), Box::new(taker))
            }
            None => {
                let maker = PartMaker { gpu, quality: &quality, passes: &passes };
                let (parts, groups) = maker.parts(projection, size, stereo);
                LightSource::Parts(parts, groups)
            }
        };
        let format = match &source {
            LightSource::Sphere(sphere, _) => sphere.lights[0].texture().format(),
            LightSource::Parts(parts, _) => parts[0].picture.light().texture().format(),
        };
        let usage = wgpu::TextureUsages::COPY_DST
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::RENDER_ATTACHMENT;
        let whole = matches!(&source, LightSource::Parts(parts, _) if stereo.is_none() && parts[0].size == size);
        let eyes = if stereo.is_some() { 2 } else { usize::from(!whole) };
        let lights = (0..eyes).map(|_| texture(gpu, "joined light", size, format, 1, usage)).collect();
        let resample = resample(gpu, colour, quality.smooth);
        Self {
            size,
            quality,
            passes,
            resample,
            source,
            lights,
            stored: Stored::UNSHIFTED,
            certainty: Certainty::default(),
        }
    }

    /// Begins what can be worked out of a picture beside other drawing: the photo-surface of its first eye.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(&self, gpu: &Gpu, renderer: &mut SceneRenderer, view: &ProjectedView) -> Result<Pending, GpuError> {
        match &self.source {
            LightSource::Parts(_, groups) => groups[0].submit(gpu, renderer, view),
            LightSource::Sphere(sphere, taker) => sphere.submit(gpu, renderer, &taker.view(view)),
        }
    }

    /// Draws the light of all eyes. `pending` is what [`submit`](Self::submit) gave for the view.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        view: &ProjectedView,
        pending: Pending,
    ) -> Result<(), GpuError> {
        let Self { size, quality, passes, resample, source, lights, stored, certainty } = self;
        let (parts, groups) = match source {
            LightSource::Parts(parts, groups) => (parts, groups),
            LightSource::Sphere(sphere, taker) => {
                sphere.draw(gpu, renderer, &taker.view(view), pending)?;
                (*stored, *certainty) = (sphere.stored, sphere.certainty);
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                for (light, of_sphere) in lights.iter().zip(sphere.lights()) {
                    taker.take(gpu, &mut encoder, of_sphere, light);
                }
                gpu.queue.submit([encoder.finish()]);
                return Ok(());
            }
        };
        let stored_scale = Some(view.gaze.shot(view.fov_deg, view.effects).scale());
        *certainty = Certainty::default();
        let strips = groups.len() > 2;
        let mut next = Some(pending);
        for (number, group) in groups.iter().enumerate() {
            let pending = next.take().unwrap_or_default();
            renderer.show(gpu, pending)?;
            // The next eye's photo-surface is worked out while this one's is drawn.
            next = groups.get(number + 1).map(|group| group.submit(gpu, renderer, view)).transpose()?;
            let mut aimed = Vec::new();
            for place in &group.places {
                let ProjectedPart { picture, screen, size: part_size } = &mut parts[place.part];
                let (flat, place_m) = screen.seen(view, *part_size, group.from_m);
                let eye = OccupantEye {
                    observer: group.observer(view),
                    observer_from_room: view.gaze.observer_from_eye * DQuat::from_mat3(&place.eye_from_part),
                    place_m,
                };
                let (enlarger, effects) = (None, view.effects);
                let context = EyeContext { gpu, quality, passes, enlarger, resample, eye, effects, stored_scale };
                let shots = picture.aim(flat.as_ref(), renderer, &context);
                aimed.push((place, context, shots.expect("the eye is before its own picture")));
            }
            let all: Vec<_> = aimed.iter().flat_map(|(_, _, shots)| shots.iter().copied()).collect();
            renderer.prepare_eye(gpu, &all);
            for (place, context, shots) in &aimed {
                let ProjectedPart { picture, size: part_size, .. } = &mut parts[place.part];
                let drawn = picture.draw(renderer, shots, context);
                // A strip is too narrow to estimate anything from the edges in it.
                if !strips {
                    *certainty = certainty.or_worse(drawn);
                }
                *stored = picture.stored;
                if let Some(light) = lights.get(group.light) {
                    let extent = [0, 1].map(|axis| part_size[axis].min(size[axis] - place.corner[axis]));
                    copy(gpu, picture.light().texture(), light.texture(), place.corner, extent);
                }
            }
        }
        Ok(())
    }

    /// Light of each eye, the left one first.
    pub fn lights(&self) -> Vec<&wgpu::TextureView> {
        match &self.source {
            LightSource::Parts(parts, _) if self.lights.is_empty() => vec![parts[0].picture.light()],
            _ => self.lights.iter().collect(),
        }
    }

    /// Estimated errors of directions in the picture drawn last; nothing is said of strips.
    pub fn certainty(&self) -> Certainty {
        self.certainty
    }

    /// Scale in which the light is stored.
    pub fn stored(&self) -> Stored {
        self.stored
    }
}

impl EyeGroup {
    /// Observer at the eye.
    fn observer(&self, view: &ProjectedView) -> physics::Observer {
        view.gaze.observer.at_offset(view.gaze.observer_from_eye * self.from_m)
    }

    fn submit(&self, gpu: &Gpu, renderer: &mut SceneRenderer, view: &ProjectedView) -> Result<Pending, GpuError> {
        renderer.submit(gpu, &self.observer(view), view.effects)
    }
}

impl PartScreen {
    /// Flat screen of a part of `size` pixels, and the place of the eye before it, axes of the part, metres.
    fn seen(&self, view: &ProjectedView, size: [u32; 2], from_m: DVec3) -> (Option<FlatSurface>, DVec3) {
        match self {
            Self::Round => (None, DVec3::ZERO),
            Self::Face(face) => (Some(*face), DVec3::ZERO),
            Self::Wall(wall_m) => {
                let up = 2.0 * wall_m * (0.5 * view.fov_deg.to_radians()).tan();
                let right = up * f64::from(size[0]) / f64::from(size[1]);
                let (right, up) = (DVec3::X * right, DVec3::Y * up);
                let lower_left = DVec3::NEG_Z * *wall_m - 0.5 * (right + up);
                (Some(FlatSurface { lower_left, right, up }), from_m)
            }
        }
    }
}

/// Maker of a picture's parts.
struct PartMaker<'a> {
    gpu: &'a Gpu,
    quality: &'a Quality,
    passes: &'a Developer,
}

impl PartMaker<'_> {
    /// Parts of a picture of `size` pixels for each eye, and the eyes that see them.
    fn parts(
        &self,
        projection: Projection,
        size @ [width, height]: [u32; 2],
        stereo: Option<StereoEyes>,
    ) -> (Vec<ProjectedPart>, Vec<EyeGroup>) {
        let whole = |part| PartPlace { part, corner: [0, 0], eye_from_part: DMat3::IDENTITY };
        let middle = |places| EyeGroup { light: 0, from_m: DVec3::ZERO, places };
        let asides = stereo.map(|eyes| [-0.5, 0.5].map(|side| side * eyes.separation_m));
        match (projection, stereo, asides) {
            (Projection::Flat, stereo, asides) => {
                let part = self.flat(size, PartScreen::Wall(stereo.map_or(1.0, |eyes| eyes.wall_m)));
                let eyes = asides.map_or(vec![0.0], |asides| asides.to_vec());
                let group = |(light, aside_m)| EyeGroup { light, from_m: DVec3::X * aside_m, places: vec![whole(0)] };
                (vec![part], eyes.into_iter().enumerate().map(group).collect())
            }
            (Projection::Cube, ..) => {
                let side = height / 2;
                let face =
                    FlatSurface { lower_left: DVec3::new(-1.0, -1.0, -1.0), right: 2.0 * DVec3::X, up: 2.0 * DVec3::Y };
                let place = |(number, [right, up, back]): (usize, [DVec3; 3])| PartPlace {
                    part: number,
                    corner: [number as u32 % 3 * side, number as u32 / 3 * side],
                    eye_from_part: DMat3::from_cols(right, up, back),
                };
                let faces = FACES.iter().map(|_| self.flat([side; 2], PartScreen::Face(face))).collect();
                (faces, vec![middle(FACES.into_iter().enumerate().map(place).collect())])
            }
            (_, Some(eyes), Some(asides)) => {
                let turn = if projection == Projection::Vr180 { PI } else { TAU };
                let strip = strip_width(eyes.separation_m).min(width);
                let angle = |pixels: f64| pixels / f64::from(width) * turn;
                let direction = |place: DVec2| {
                    let across = (place.x - 0.5) * f64::from(strip) / f64::from(width) * turn / TAU + 0.5;
                    // A place of the strip is one of a sphere's picture.
                    Projection::Sphere.direction([1, 1], DVec2::new(across, place.y))
                };
                let part = self.round([strip, height], direction);
                let mut groups = Vec::new();
                for number in 0..width.div_ceil(strip) {
                    // The last strip lies over the one before.
                    let left = (number * strip).min(width - strip);
                    let longitude = angle(f64::from(left) + 0.5 * f64::from(strip)) - 0.5 * turn;
                    let eye_from_part = DMat3::from_rotation_y(-longitude);
                    for (light, aside_m) in asides.into_iter().enumerate() {
                        let places = vec![PartPlace { part: 0, corner: [left, 0], eye_from_part }];
                        groups.push(EyeGroup { light, from_m: eye_from_part.x_axis * aside_m, places });
                    }
                }
                (vec![part], groups)
            }
            _ => {
                let direction = |place: DVec2| {
                    let pixels = DVec2::new(f64::from(width), f64::from(height));
                    projection.direction(size, place * pixels)
                };
                (vec![self.round(size, direction)], vec![middle(vec![whole(0)])])
            }
        }
    }

    fn flat(&self, size: [u32; 2], screen: PartScreen) -> ProjectedPart {
        ProjectedPart { picture: ChannelPicture::flat(self.gpu, size, self.quality, self.passes), size, screen }
    }

    /// ProjectedPart whose places, 0 to 1 from the upper left, show these directions.
    fn round(&self, size: [u32; 2], direction: impl Fn(DVec2) -> Option<DVec3> + Sync) -> ProjectedPart {
        let curved = Curved::of_places(self.gpu, size, direction, self.quality.format);
        let picture = ChannelPicture::curved(self.gpu, curved, self.quality, self.passes);
        ProjectedPart { picture, size, screen: PartScreen::Round }
    }
}

/// Width of a strip, pixels, whatever the width of the picture.
///
/// *Equation:* the eye of a strip's edge is the half separation times half of the strip's angle off that of its middle.
/// At the distance of [`NEAR_M`] that is [`STRIP_ERROR_PIXELS`] of a pixel's angle.
fn strip_width(separation_m: f64) -> u32 {
    let pixels = 2.0 * STRIP_ERROR_PIXELS * NEAR_M / (0.5 * separation_m);
    (pixels as u32).clamp(1, 64)
}

/// Width of a sphere that is finer than a picture of `size` pixels, pixels.
fn sphere_width(projection: Projection, size: [u32; 2]) -> f64 {
    let side = f64::from(size[1]);
    let pixels_per_radian = match projection {
        Projection::Fisheye { full_rad } => side / full_rad,
        // Towards its edges a face is twice as fine as in its middle.
        Projection::Cube => 0.5 * side,
        Projection::Flat | Projection::Sphere | Projection::Vr180 => side / PI,
    };
    FINER * TAU * pixels_per_radian
}

/// Copies a picture into a larger one.
fn copy(gpu: &Gpu, from: &wgpu::Texture, to: &wgpu::Texture, corner: [u32; 2], extent: [u32; 2]) {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let origin = wgpu::Origin3d { x: corner[0], y: corner[1], z: 0 };
    encoder.copy_texture_to_texture(
        from.as_image_copy(),
        wgpu::TexelCopyTextureInfo { origin, ..to.as_image_copy() },
        wgpu::Extent3d { width: extent[0], height: extent[1], depth_or_array_layers: 1 },
    );
    gpu.queue.submit([encoder.finish()]);
}
