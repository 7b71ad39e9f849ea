//! Law: what Rust writes is what the shader reads. A field moved, added or resized on one side only would show
//! here as a different offset; a shader that does not parse or validate fails here, not on a visitor's machine.

use naga::{Module, TypeInner, front::wgsl, valid};
use std::mem::{offset_of, size_of};

fn parse(module: &shaders::Module) -> Module {
    wgsl::parse_str(&module.source()).unwrap_or_else(|error| panic!("{}: {error}", module.name))
}

/// Offset of each field, and the size of the whole, as naga lays the struct out.
fn reflected(module: &Module, name: &str) -> (Vec<(String, usize)>, usize) {
    let (_, kind) = module
        .types
        .iter()
        .find(|(_, kind)| kind.name.as_deref() == Some(name))
        .expect("the shader declares the struct");
    let TypeInner::Struct { members, span } = &kind.inner else { panic!("{name} is not a struct") };
    let fields = members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset as usize)).collect();
    (fields, *span as usize)
}

macro_rules! assert_mirrors {
    ($module:expr, $name:ident { $($field:ident),* }) => {
        let expected = vec![$((stringify!($field).to_owned(), offset_of!(shaders::$name, $field))),*];
        assert_eq!(reflected(&$module, stringify!($name)), (expected, size_of::<shaders::$name>()));
    };
}

#[test]
fn every_module_validates() {
    for module in shaders::MODULES {
        let parsed = parse(&module);
        // Headsets alone draw two views in one pass.
        valid::Validator::new(valid::ValidationFlags::all(), valid::Capabilities::MULTIVIEW)
            .validate(&parsed)
            .unwrap_or_else(|error| panic!("{}: {error:?}", module.name));
    }
}

#[test]
fn structs_have_the_same_layout_on_both_sides() {
    let surface = parse(&shaders::SURFACE);
    assert_mirrors!(
        surface,
        ViewUniforms { clip_from_observer, forward, right, up, motion, shift, layer, source, eye, eye_rest }
    );
    assert_mirrors!(
        surface,
        LightingUniforms {
            shadow_from_world,
            sun_direction,
            sun,
            ambient_red,
            ambient_green,
            ambient_blue,
            ground,
            zenith,
            horizon,
            background
        }
    );
    assert_mirrors!(surface, MaterialUniforms { base_colour, emissive, carriers });
    let warp = parse(&shaders::WARP);
    assert_mirrors!(warp, AtlasTile { corner, scale, low, high });
    assert_mirrors!(warp, MapUniforms { cube_from_observer });
    assert_mirrors!(parse(&shaders::ACCUMULATE), AccumulateUniforms { weight });
    let meter = parse(&shaders::METER);
    assert_mirrors!(
        meter,
        MeteringUniforms { exposure, log2_exposure, log2_scale, share, automatic, gains, luminances, columns, rows }
    );
    assert_mirrors!(parse(&shaders::DISPLAY), PlacementUniforms { origin, exposure, odd });
    assert_mirrors!(parse(&shaders::ROOM), RoomViewUniforms { clip_from_room });
    assert_mirrors!(parse(&shaders::RESAMPLE), FacetUniforms { eye, right, up, forward, texel });
    assert_mirrors!(
        parse(&shaders::SHEET),
        SheetUniforms { eye, corner, right, up, screen_corner, screen_right, screen_up, viewport }
    );
    assert_mirrors!(
        parse(&shaders::VEIL),
        VeilUniforms { eye, ahead, screen_corner, screen_right, screen_up, viewport, shade }
    );
    assert_mirrors!(parse(&shaders::INTERFACE), InterfaceUniforms { size });
    assert_mirrors!(meter, AdaptationState { exposure, white, log2_exposure, gain, bright });
}
