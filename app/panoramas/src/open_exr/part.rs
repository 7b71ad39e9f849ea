//! Part of a file, and its channels, that make a panorama.

use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::{ChannelDescription, SampleType};
use exr::meta::header::Header;

/// Channels that make colours, by their indices in the part's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ColourChannels {
    /// Red, green, blue.
    Rgb([usize; 3]),
    /// Luminance.
    Grey(usize),
    /// Luminance, (R − Y) / Y and (B − Y) / Y.
    LuminanceChroma([usize; 3]),
}

/// Part of a file that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DrawnPart {
    /// Index of the part.
    pub(super) index: usize,
    /// Channels of its colours.
    pub(super) channels: ColourChannels,
    /// Sentence on what is not drawn, if there is a choice.
    pub(super) notice: Option<String>,
}

impl ColourChannels {
    /// Indices of the channels.
    pub(super) fn indices(&self) -> &[usize] {
        match self {
            Self::Rgb(indices) | Self::LuminanceChroma(indices) => indices,
            Self::Grey(index) => std::slice::from_ref(index),
        }
    }
}

/// Part to draw: the first with colours in channels of its own, or else the first with colours in a layer.
///
/// # Errors
/// A fault that says what the file has instead.
pub(super) fn drawn_part(meta: &MetaData) -> Result<DrawnPart, String> {
    let headers = meta.headers.as_slice();
    // A file of one part says that it is deep at its beginning, and need not say so in its header.
    let all_deep = meta.requirements.has_deep_data && !meta.requirements.has_multiple_layers;
    let flat = || headers.iter().enumerate().filter(|(_, header)| !all_deep && !header.deep);
    if flat().next().is_none() {
        return Err("it is deep data, with many samples in a pixel; flatten it".into());
    }
    let own = flat().find_map(|(index, header)| Some((index, String::new(), colours(&header.channels.list, "")?)));
    let layered = || {
        flat().find_map(|(index, header)| {
            let channels = &header.channels.list;
            channels.iter().find_map(|channel| {
                let name = channel.name.to_string();
                let prefix = &name[..name.rfind('.')? + 1];
                Some((index, prefix.to_owned(), colours(channels, prefix)?))
            })
        })
    };
    let Some((index, prefix, channels)) = own.or_else(layered) else {
        let names: Vec<_> =
            flat().flat_map(|(_, header)| &header.channels.list).map(|one| one.name.to_string()).collect();
        return Err(format!(
            "it has no channels R, G and B, and no Y, but {}",
            names[..names.len().min(20)].join(", ")
        ));
    };
    let part = headers[index].own_attributes.layer_name.as_ref().map(ToString::to_string).unwrap_or_default();
    let what = match (prefix.trim_end_matches('.'), part) {
        ("", part) if headers.len() > 1 => Some(part),
        ("", _) => None,
        (layer, _) => Some(layer.to_owned()),
    };
    let notice = what.map(|what| format!("the file has layers; \"{what}\" is drawn, the first with colours"));
    Ok(DrawnPart { index, channels, notice })
}

/// Refuses channels whose resolution does not divide the picture, as OpenEXR does.
pub(super) fn check_resolutions(header: &Header) -> Result<(), String> {
    let Vec2(width, height) = header.layer_size;
    let (Vec2(left, top), tiled) = (header.own_attributes.layer_position, header.blocks.has_tiles());
    for channel in &header.channels.list {
        let Vec2(across, down) = channel.sampling;
        let lower = across != 1 || down != 1;
        let divides = |side: usize, from: i32, step: usize| {
            step > 0 && side.is_multiple_of(step) && i64::from(from) % step as i64 == 0
        };
        if lower && (tiled || !divides(width, left, across) || !divides(height, top, down)) {
            return Err(format!("the resolution of its channel {} does not divide the picture", channel.name));
        }
    }
    Ok(())
}

/// Channels of the colours whose names begin with a prefix.
fn colours(channels: &[ChannelDescription], prefix: &str) -> Option<ColourChannels> {
    let find = |letters: &str| {
        let named = |channel: &ChannelDescription| {
            let name = channel.name.to_string();
            name.strip_prefix(prefix).is_some_and(|rest| rest.eq_ignore_ascii_case(letters))
        };
        channels.iter().position(named)
    };
    if let (Some(red), Some(green), Some(blue)) = (find("R"), find("G"), find("B")) {
        return Some(ColourChannels::Rgb([red, green, blue]));
    }
    let luminance = find("Y")?;
    Some(match (find("RY"), find("BY")) {
        (Some(red), Some(blue)) => ColourChannels::LuminanceChroma([luminance, red, blue]),
        _ => ColourChannels::Grey(luminance),
    })
}

/// Size of a channel's number, bytes.
pub(super) fn bytes_of(channel: &ChannelDescription) -> usize {
    if channel.sample_type == SampleType::F16 { 2 } else { 4 }
}
