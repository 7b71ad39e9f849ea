//! The shader's `world_from_observer` must be `physics::Aberration::world_from_observer` in f32, and its
//! `doppler_of_world` the Doppler factor of `observer_from_world`. Sky, colours and brightness depend on them.
//!
//! In a wrong program, the textbook formula makes directions scatter ahead at high speed. A swapped sign agrees at
//! rest only. D in place of 1/D gives a Doppler factor that is right nowhere but abeam at rest.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use exact_reference::random::{direction, seeded};
use glam::{DVec3, Vec3, Vec4};
use physics::{Aberration, Celerity};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use system_tests::photographer::gpu;
use wgpu::util::DeviceExt;

/// Tolerance in steps of f32 for a well-conditioned result: about eight operations of half a step contribute, and
/// division and square root may be 2.5 steps off (WGSL 15.7.4).
const STEPS: f64 = 8.0;

/// Question to shader and physics: a motion in the shader's form, and a direction in the observer's axes.
struct Question {
    motion: Vec4,
    observed: Vec3,
}

impl Question {
    /// Random question for a rapidity, with a direction at `angle` from the motion.
    fn new(random: &mut ChaCha8Rng, rapidity: f64, angle: f64) -> Self {
        let along = direction(random);
        let across = along.cross(direction(random)).normalize();
        Self {
            motion: along.as_vec3().extend(rapidity.exp() as f32),
            observed: (along * angle.cos() + across * angle.sin()).as_vec3(),
        }
    }

    /// Exact answer in f64 to the rounded question.
    fn exact(&self) -> (DVec3, f64) {
        let rapidity = f64::from(self.motion.w).ln();
        let celerity = Celerity::from_rapidity(self.motion.truncate().as_dvec3(), rapidity).unwrap();
        Aberration::new(celerity).world_from_observer(self.observed.as_dvec3())
    }
}

/// Answers of an entry point of the probe shader.
fn answers(entry_point: &str, questions: &[Question]) -> Vec<Vec4> {
    let gpu = gpu();
    let device = &gpu.device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(shaders::PROBE.name),
        source: wgpu::ShaderSource::Wgsl(shaders::PROBE.source().into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("aberration"),
        layout: None,
        module: &module,
        entry_point: Some(entry_point),
        compilation_options: Default::default(),
        cache: None,
    });
    let input = |contents: Vec<Vec4>| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("questions"),
            contents: bytemuck::cast_slice(&contents),
            usage: wgpu::BufferUsages::STORAGE,
        })
    };
    let bytes = (questions.len() * size_of::<Vec4>()) as u64;
    let output = |usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("answers"),
            size: bytes,
            usage,
            mapped_at_creation: false,
        })
    };
    let motion = input(questions.iter().map(|question| question.motion).collect());
    let observed = input(questions.iter().map(|question| question.observed.extend(0.0)).collect());
    let result = output(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let readback = output(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("aberration"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: motion.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: observed.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: result.as_entire_binding() },
        ],
    });

    // Submit the questions.
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(questions.len().div_ceil(64) as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&result, 0, &readback, 0, bytes);
    gpu.queue.submit([encoder.finish()]);

    // Read the answers.
    readback.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait().unwrap();
    let mapped = readback.get_mapped_range(..).unwrap();
    bytemuck::cast_slice(&mapped).to_vec()
}

/// Asserts that shader and physics agree up to rounding.
///
/// The part of a direction across the motion is known to one step. Aberration enlarges that error by D, which limits
/// the error of the direction. D falls with the square of that part from 2γ dead ahead, so close to there D is known
/// only to one step divided by the angle.
fn assert_twins(questions: &[Question]) {
    for (question, answer) in questions.iter().zip(answers("aberration", questions)) {
        let Question { motion, observed } = question;
        let (direction, doppler) = question.exact();
        let step = STEPS * f64::from(f32::EPSILON);
        let allowed = step * (1.0 + doppler);
        let error = answer.truncate().as_dvec3().distance(direction);
        assert!(error <= allowed, "{error} > {allowed} rad for {observed} at {motion}");

        let off_ahead = observed.as_dvec3().distance(motion.truncate().as_dvec3());
        let allowed = step * (1.0 + 1.0 / (off_ahead + 1.0 / f64::from(motion.w)));
        let error = (f64::from(answer.w) / doppler - 1.0).abs();
        assert!(error <= allowed, "D is off by {error} > {allowed} of {doppler} for {observed} at {motion}");
    }
}

#[test]
fn abeam_of_an_observer_at_0_6_c_light_comes_from_astern_gpu() {
    // Here kappa = gamma + u = 1.25 + 0.75; cos(theta) = -beta, D = 1 / gamma.
    let question = Question { motion: Vec4::new(1.0, 0.0, 0.0, 2.0), observed: Vec3::Y };
    assert_eq!(answers("aberration", &[question]), [Vec4::new(-0.6, 0.8, 0.0, 0.8)]);
}

#[test]
fn an_observer_at_rest_sees_every_direction_as_it_is_gpu() {
    let mut random = seeded(1);
    let questions: Vec<_> = (0..1000)
        .map(|_| Question { motion: Vec4::new(0.0, 0.0, -1.0, 1.0), observed: direction(&mut random).as_vec3() })
        .collect();
    for (question, answer) in questions.iter().zip(answers("aberration", &questions)) {
        assert!(answer.truncate().distance(question.observed) <= 4.0 * f32::EPSILON);
        assert!((answer.w - 1.0).abs() <= 4.0 * f32::EPSILON);
    }
}

#[test]
fn random_directions_agree_with_physics_gpu() {
    let mut random = seeded(2);
    let questions: Vec<_> = (0..100_000)
        .map(|_| {
            let (rapidity, angle) = (random.random_range(0.0..14.0), random.random_range(0.0..std::f64::consts::PI));
            Question::new(&mut random, rapidity, angle)
        })
        .collect();
    assert_twins(&questions);
}

#[test]
fn directions_close_to_ahead_and_astern_agree_with_physics_gpu() {
    let mut random = seeded(3);
    let questions: Vec<_> = (0..100_000)
        .map(|index| {
            let (rapidity, small) = (random.random_range(0.0..10.0), 10.0_f64.powf(random.random_range(-6.0..0.0)));
            let angle = if index % 2 == 0 { small } else { std::f64::consts::PI - small };
            Question::new(&mut random, rapidity, angle)
        })
        .collect();
    assert_twins(&questions);
}

#[test]
fn doppler_factors_of_world_directions_agree_with_physics_gpu() {
    let mut random = seeded(4);
    let questions: Vec<_> = (0..100_000)
        .map(|_| {
            let (rapidity, angle) = (random.random_range(0.0..14.0), random.random_range(0.0..std::f64::consts::PI));
            Question::new(&mut random, rapidity, angle)
        })
        .collect();
    for (question, answer) in questions.iter().zip(answers("doppler", &questions)) {
        let Question { motion, observed } = question;
        let rapidity = f64::from(motion.w).ln();
        let celerity = Celerity::from_rapidity(motion.truncate().as_dvec3(), rapidity).unwrap();
        let (_, doppler) = Aberration::new(celerity).observer_from_world(observed.as_dvec3());
        // D falls with the square of the angle off astern down to 1/2γ, so there it is known to one step divided by
        // the angle.
        let off_astern = observed.as_dvec3().distance(-motion.truncate().as_dvec3());
        let allowed = STEPS * f64::from(f32::EPSILON) * (1.0 + 1.0 / (off_astern + 1.0 / f64::from(motion.w)));
        let error = (f64::from(answer.x) / doppler - 1.0).abs();
        assert!(error <= allowed, "D is off by {error} > {allowed} of {doppler} for {observed} at {motion}");
    }
}
