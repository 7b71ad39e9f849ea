//! Pictures of the room itself, seen from any place: for work on a display whose hardware is elsewhere.
//!
//! Every channel of one eye is a net of its screen's points that carries the channel's picture. The light of
//! overlapping projectors adds up, as on the real screen. Screens seen from behind are drawn as outlines only, so
//! that the inside can be seen from outside. Screens seen from the front do not hide each other in a convex room, so
//! there is no depth buffer.

use crate::head::Occupant;
use crate::walls::Walls;
use bytemuck::{Pod, Zeroable, bytes_of, cast_slice};
use glam::{DMat4, DVec2, DVec3, Vec2, Vec3};
use physics::Celerity;
use render::Gpu;
use render::display::{self, Development, Pass};
use render::shader_view;
use render::target::texture;
use room::{Channel, EyeSide};
use std::f64::consts::TAU;
use view::{Camera, PixelSample, Places};
use wgpu::util::DeviceExt;

/// Number of cells along each side of the net of a channel whose screen is not flat.
const CELLS: u32 = 192;
/// Half side of the grid on the ground, and distance between its lines, metres.
const GROUND_M: (f64, f64) = (6.0, 0.5);
/// Radius of the drawn head, metres.
const HEAD_M: f64 = 0.11;
/// Linear light of the lines on the ground.
const GROUND_LIGHT: f32 = 0.02;
const HEAD_LIGHT: f32 = 0.6;

/// Point of view from which the room is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoomOnlooker {
    /// Place of the onlooker, room axes, metres.
    pub from_m: DVec3,
    /// Point in the picture's middle, room axes, metres.
    pub towards_m: DVec3,
    /// Full vertical angle of view, degrees.
    pub fov_degrees: f64,
}

impl RoomOnlooker {
    /// Onlooker outside the room: behind, to the right of and above the head, far enough away that all screens are in
    /// sight.
    pub fn outside(walls: &Walls) -> Self {
        let display = &walls.display;
        let places = [0.0, 0.5, 1.0].into_iter().flat_map(|y| [0.0, 0.5, 1.0].map(|x| DVec2::new(x, y)));
        let point = |channel: &Channel| {
            let places = places.clone();
            places.filter_map(|place| channel.point(display, place)).collect::<Vec<_>>()
        };
        let points: Vec<_> = display.channels.iter().flat_map(point).collect();
        let low = points.iter().copied().fold(display.viewer.head_m, DVec3::min);
        let high = points.iter().copied().fold(display.viewer.head_m, DVec3::max);
        let reach = (high - low).length();
        let towards_m = 0.5 * (low + high);
        Self {
            from_m: towards_m + DVec3::new(0.45, 0.35, 1.0).normalize() * (0.95 * reach),
            towards_m,
            fov_degrees: 55.0,
        }
    }

    /// Moves around the point in the middle by angles to the right and up, radians, and divides the distance to it by
    /// `closer`.
    pub fn orbit(&mut self, right_rad: f64, up_rad: f64, closer: f64) {
        /// Smallest angle from straight above or below, radians.
        const NEAREST_RAD: f64 = 0.05;
        let from = self.from_m - self.towards_m;
        let level = f64::hypot(from.x, from.z);
        let limit = std::f64::consts::FRAC_PI_2 - NEAREST_RAD;
        let height = (from.y.atan2(level) + up_rad).clamp(-limit, limit);
        let bearing = from.x.atan2(from.z) + right_rad;
        let direction = DVec3::new(bearing.sin() * height.cos(), height.sin(), bearing.cos() * height.cos());
        self.from_m = self.towards_m + direction * (from.length() / closer).clamp(0.1, 1000.0);
    }

    fn clip_from_room(&self, size: [u32; 2]) -> DMat4 {
        let camera = Camera::looking(self.towards_m - self.from_m, DVec3::Y, self.fov_degrees.to_radians());
        let view = shader_view(&camera, size, PixelSample::WHOLE, Celerity::ZERO, Places::Instant, 1.0);
        view.clip_from_observer.as_dmat4() * DMat4::from_translation(-self.from_m)
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct NetCorner {
    point: Vec3,
    place: Vec2,
    /// 0 in pictures whose edges are drawn, 1 elsewhere.
    edge: f32,
}

/// Pipelines and buffers that draw a room.
pub struct Preview {
    eye: EyeSide,
    nets: Vec<Net>,
    lines: wgpu::Buffer,
    surfaces: wgpu::RenderPipeline,
    strokes: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    encoded: Pass,
    linear: Option<wgpu::TextureView>,
}

/// Points of one channel.
struct Net {
    channel: usize,
    corners: wgpu::Buffer,
    count: u32,
}

impl Preview {
    /// Creates the preview of one eye's channels: of the left eye where there are two.
    pub fn new(gpu: &Gpu, walls: &Walls, screen: wgpu::TextureFormat) -> Self {
        let eye = walls
            .display
            .channels
            .iter()
            .map(|channel| channel.eye)
            .find(|eye| *eye != EyeSide::Right)
            .unwrap_or(EyeSide::Right);
        let of_eye = walls.display.channels.iter().enumerate().filter(|(_, channel)| channel.eye == eye);
        let nets = of_eye.filter_map(|(index, channel)| net(gpu, walls, index, channel)).collect();
        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let picture = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("room"),
            entries: &[entry(0, uniform), entry(1, picture)],
        });
        let pipeline = |lines| pipeline(gpu, &layout, lines);
        Self {
            eye,
            nets,
            lines: buffer(gpu, &ground(walls)),
            surfaces: pipeline(false),
            strokes: pipeline(true),
            encoded: display::encoded(gpu, screen),
            layout,
            linear: None,
        }
    }

    /// Draws the room with the present pictures of its channels, and the occupant's head in it.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        walls: &mut Walls,
        (occupant, onlooker): (&Occupant, &RoomOnlooker),
        development: &Development,
        screen: &wgpu::TextureView,
    ) {
        let extent = screen.texture().size();
        let size = [extent.width, extent.height];
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let fits = self.linear.take().filter(|linear| linear.texture().size() == extent);
        let linear = fits.unwrap_or_else(|| texture(gpu, "room", size, display::LINEAR_FORMAT, 1, usage));

        let uniform = shaders::RoomViewUniforms { clip_from_room: onlooker.clip_from_room(size).as_mat4() };
        let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("room"),
            contents: bytes_of(&uniform),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let shown: Vec<_> =
            self.nets.iter().map(|net| walls.developed(gpu, encoder, net.channel, development)).collect();
        let group = |picture: &wgpu::TextureView| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("room"),
                layout: &self.layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(picture) },
                ],
            })
        };
        let groups: Vec<_> = shown.iter().map(group).collect();
        let head = buffer(gpu, &head(walls, occupant, self.eye));
        let mut pass = display::clear(encoder, &linear);
        if let Some(group) = groups.first() {
            pass.set_bind_group(0, group, &[]);
            pass.set_pipeline(&self.strokes);
            pass.set_vertex_buffer(0, self.lines.slice(..));
            pass.draw(0..corners(&self.lines), 0..1);
        }
        pass.set_pipeline(&self.surfaces);
        for (net, group) in self.nets.iter().zip(&groups) {
            pass.set_bind_group(0, group, &[]);
            pass.set_vertex_buffer(0, net.corners.slice(..));
            pass.draw(0..net.count, 0..1);
        }
        if !groups.is_empty() {
            pass.set_pipeline(&self.strokes);
            pass.set_vertex_buffer(0, head.slice(..));
            pass.draw(0..corners(&head), 0..1);
        }
        drop(pass);
        self.encoded.draw(gpu, encoder, screen, &[wgpu::BindingResource::TextureView(&linear)]);
        self.linear = Some(linear);
    }
}

fn corners(buffer: &wgpu::Buffer) -> u32 {
    (buffer.size() / size_of::<NetCorner>() as u64) as u32
}

fn buffer(gpu: &Gpu, corners: &[NetCorner]) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("room"),
        contents: cast_slice(corners),
        usage: wgpu::BufferUsages::VERTEX,
    })
}

fn pipeline(gpu: &Gpu, layout: &wgpu::BindGroupLayout, lines: bool) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(shaders::ROOM.name),
        source: wgpu::ShaderSource::Wgsl(shaders::ROOM.source().into()),
    });
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x2, 2 => Float32];
    let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("room"),
        bind_group_layouts: &[Some(layout)],
        ..Default::default()
    });
    let added = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("room"),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<NetCorner>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &attributes,
            })],
        },
        primitive: wgpu::PrimitiveState {
            topology: if lines { wgpu::PrimitiveTopology::LineList } else { wgpu::PrimitiveTopology::TriangleList },
            ..Default::default()
        },
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("LINES", f64::from(u8::from(lines)))],
                ..Default::default()
            },
            targets: &[Some(wgpu::ColorTargetState {
                format: display::LINEAR_FORMAT,
                blend: Some(wgpu::BlendState { color: added, alpha: added }),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Net of a channel; `None` if the channel lights nothing.
fn net(gpu: &Gpu, walls: &Walls, index: usize, channel: &Channel) -> Option<Net> {
    let cells = if channel.flat(&walls.display).is_some() { 1 } else { CELLS };
    // The edges of a projector's picture are not edges of the screen.
    let outlined = channel.projector.is_none();
    let corner = |column: u32, row: u32| {
        let share = |at: u32| f64::from(at) / f64::from(cells);
        let place = DVec2::new(share(column), share(row));
        let inside = place.clamp(DVec2::splat(1e-9), DVec2::splat(1.0 - 1e-9));
        let point = channel.point(&walls.display, inside)?.as_vec3();
        Some(NetCorner { point, place: place.as_vec2(), edge: if outlined { 0.0 } else { 1.0 } })
    };
    let mut triangles = Vec::new();
    for row in 0..cells {
        for column in 0..cells {
            let cell = [[column, row], [column, row + 1], [column + 1, row + 1], [column + 1, row]];
            match cell.map(|[column, row]| corner(column, row)) {
                [Some(a), Some(b), Some(c), Some(d)] => triangles.extend([a, b, c, a, c, d]),
                // Three lit corners of a cell make one triangle.
                corners => {
                    let lit: Vec<_> = corners.into_iter().flatten().collect();
                    if lit.len() == 3 {
                        triangles.extend(lit);
                    }
                }
            }
        }
    }
    let count = triangles.len() as u32;
    (count > 0).then(|| Net { channel: index, corners: buffer(gpu, &triangles), count })
}

/// End of a line, with the line's linear light.
fn end(point: DVec3, light: f32) -> NetCorner {
    NetCorner { point: point.as_vec3(), place: Vec2::splat(light), edge: 1.0 }
}

/// Grid of lines on the ground, the room's plane y = 0.
fn ground(walls: &Walls) -> Vec<NetCorner> {
    let (half, step) = GROUND_M;
    let centre = walls.display.viewer.head_m * DVec3::new(1.0, 0.0, 1.0);
    let count = (half / step) as i32;
    let lines = (-count..=count).flat_map(|line| {
        let aside = f64::from(line) * step;
        let ends = [
            DVec3::new(aside, 0.0, -half),
            DVec3::new(aside, 0.0, half),
            DVec3::new(-half, 0.0, aside),
            DVec3::new(half, 0.0, aside),
        ];
        ends.map(|place| end(centre + place, GROUND_LIGHT))
    });
    lines.collect()
}

/// Lines of the head: three circles, and a line from the eye in the direction it faces.
fn head(walls: &Walls, occupant: &Occupant, eye: EyeSide) -> Vec<NetCorner> {
    const STEPS: u32 = 32;
    let head = &occupant.head;
    let seen_from = walls.display.viewer.eye_m(eye, head.place_m, head.room_from_head);
    let axes = head.room_from_head;
    let mut lines = Vec::new();
    for [one, other] in [[axes.x_axis, axes.y_axis], [axes.y_axis, axes.z_axis], [axes.z_axis, axes.x_axis]] {
        let at = |step: u32| {
            let (sine, cosine) = (TAU * f64::from(step) / f64::from(STEPS)).sin_cos();
            end(head.place_m + HEAD_M * (cosine * one + sine * other), HEAD_LIGHT)
        };
        lines.extend((0..STEPS).flat_map(|step| [at(step), at(step + 1)]));
    }
    lines.extend([seen_from, seen_from - 3.0 * HEAD_M * axes.z_axis].map(|place| end(place, HEAD_LIGHT)));
    lines
}
