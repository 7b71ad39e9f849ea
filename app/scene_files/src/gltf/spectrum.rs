//! Spectra of materials and lights: `extras.spectrum`, this program's own addition to glTF.
//!
//! A spectrum is one of `{"planck": K}`, `{"sampled": [[nm, value], …]}`, `{"sampled": "paint.csv"}`, `{"rgb": [r, g,
//! b]}` and `{"gray": true}`; `"paint.csv"` and `"gray"` alone mean the same. Hand-written spectra often have more
//! than one mistake, so all mistakes of a file are collected and reported together.

use std::path::Path;

use ::gltf::json::Extras;
use physics::colour::{Spectrum, SpectrumError};
use serde_json::{Value, json};

use super::document::Document;
use super::error::{GltfError, SpectrumFault};
use super::extras::{self, OwnExtras};

/// Keys of the kinds of spectra.
const KINDS: [&str; 4] = ["planck", "sampled", "rgb", "gray"];

/// Reader of a file's spectra, which collects their faults.
pub(super) struct SpectrumReader<'a> {
    document: &'a Document<'a>,
    faults: Vec<SpectrumFault>,
}

/// Path of keys below `spectrum`, and the fault there.
type Refusal = (&'static str, String);

impl<'a> SpectrumReader<'a> {
    pub(super) fn new(document: &'a Document<'a>) -> Self {
        Self { document, faults: Vec::new() }
    }

    /// Spectrum in an object's extras, if there is a valid one.
    pub(super) fn of_extras(&mut self, extras: &Extras, owner: &str) -> Option<Spectrum> {
        let spectrum = match OwnExtras::of(extras) {
            Ok(own) => own.spectrum?,
            Err(fault) => {
                self.refuse(owner, "extras", fault);
                return None;
            }
        };
        match serde_json::from_str(spectrum.get()) {
            Ok(value) => self.read(&value, owner, "extras.spectrum"),
            Err(error) => {
                self.refuse(owner, "extras.spectrum", error.to_string());
                None
            }
        }
    }

    /// Spectrum, if it is valid; `key` is its place in its owner.
    pub(super) fn read(&mut self, value: &Value, owner: &str, key: &str) -> Option<Spectrum> {
        match self.parse(value) {
            Ok(spectrum) => Some(spectrum),
            Err((below, fault)) => {
                let key = if below.is_empty() { key.to_owned() } else { format!("{key}.{below}") };
                self.refuse(owner, &key, fault);
                None
            }
        }
    }

    pub(super) fn refuse(&mut self, owner: &str, key: &str, fault: impl Into<String>) {
        self.faults.push(SpectrumFault { owner: owner.into(), key: key.into(), fault: fault.into() });
    }

    /// Refuses the file if any spectrum was invalid.
    pub(super) fn finish(self) -> Result<(), GltfError> {
        if self.faults.is_empty() {
            return Ok(());
        }
        Err(GltfError::Spectra { path: self.document.path.clone(), faults: self.faults })
    }

    fn parse(&self, value: &Value) -> Result<Spectrum, Refusal> {
        let kinds = KINDS.join(", ");
        let object = match value {
            Value::String(text) if text == "gray" => return Ok(Spectrum::Gray),
            Value::String(name) if is_csv(name) => return self.csv(name).map_err(|fault| ("", fault)),
            Value::Object(object) => object,
            other => {
                let fault =
                    format!("expected an object with one of {kinds}, or \"gray\", or \"FILE.csv\", not {other}");
                return Err(("", fault));
            }
        };
        if let Some(unknown) = object.keys().find(|key| !KINDS.contains(&key.as_str())) {
            return Err(("", format!("there is no spectrum \"{unknown}\"; expected one of {kinds}")));
        }
        let mut given = KINDS.into_iter().filter_map(|kind| Some((kind, object.get(kind)?)));
        let Some((kind, value)) = given.next() else {
            return Err(("", format!("it is empty; expected one of {kinds}")));
        };
        if let Some((second, _)) = given.next() {
            return Err(("", format!("it is {kind} and {second} at once; keep one")));
        }
        self.kind(kind, value).map_err(|fault| (kind, fault))
    }

    fn kind(&self, kind: &str, value: &Value) -> Result<Spectrum, String> {
        let told = |error: SpectrumError| error.to_string();
        match (kind, value) {
            ("planck", Value::Number(kelvin)) => Spectrum::planck(number(kelvin)).map_err(told),
            ("planck", other) => Err(format!("expected a temperature in kelvin, a number, not {other}")),
            ("sampled", Value::String(name)) => self.csv(name),
            ("sampled", Value::Array(samples)) => {
                let samples: Vec<_> = samples.iter().enumerate().map(sample).collect::<Result<_, _>>()?;
                Spectrum::sampled(samples).map_err(told)
            }
            ("sampled", other) => {
                Err(format!("expected pairs [[nm, value], …] or the name of a .csv file, not {other}"))
            }
            ("rgb", other) => match numbers(other) {
                Some(rgb) => Spectrum::rgb(rgb).map_err(told),
                None => Err(format!("expected three numbers [red, green, blue], not {other}")),
            },
            (_, Value::Bool(true)) => Ok(Spectrum::Gray),
            (_, other) => Err(format!("expected true, not {other}")),
        }
    }

    /// Spectrum from a table of samples in a file beside the scene.
    fn csv(&self, name: &str) -> Result<Spectrum, String> {
        if !is_csv(name) {
            return Err(format!("expected the name of a .csv file, not \"{name}\""));
        }
        let bytes = self.document.fetch(name, "extras.spectrum").map_err(|error| match error {
            GltfError::Damaged { fault, .. } => fault,
            other => other.to_string(),
        })?;
        let lines = samples_of_csv(&String::from_utf8_lossy(&bytes)).map_err(|fault| format!("{name}, {fault}"))?;
        let samples: Vec<[f64; 2]> = lines.iter().map(|&(_, sample)| sample).collect();
        Spectrum::sampled(samples).map_err(|error| match error {
            SpectrumError::Wavelength { index, .. } | SpectrumError::Value { index, .. } => {
                format!("{name}, line {}: {error}", lines[index].0)
            }
            _ => format!("{name}: {error}"),
        })
    }
}

/// Spectrum as JSON that reads back the same to the bit.
pub(crate) fn to_json(spectrum: &Spectrum) -> Value {
    match spectrum {
        Spectrum::Planck { kelvin } => json!({ "planck": kelvin }),
        Spectrum::Sampled(sampled) => json!({ "sampled": sampled.samples() }),
        Spectrum::Rgb(rgb) => json!({ "rgb": rgb }),
        Spectrum::Gray => json!({ "gray": true }),
    }
}

/// Extras of an object to be written that has this spectrum.
pub(crate) fn to_extras(spectrum: &Spectrum) -> Extras {
    extras::to_extras(&json!({ "spectrum": to_json(spectrum) }))
}

fn is_csv(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

fn number(number: &serde_json::Number) -> f64 {
    number.as_f64().unwrap_or(f64::NAN)
}

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let values: Vec<f64> = value.as_array()?.iter().map(|value| value.as_f64()).collect::<Option<_>>()?;
    values.try_into().ok()
}

fn sample((index, value): (usize, &Value)) -> Result<[f64; 2], String> {
    numbers(value).ok_or_else(|| format!("expected a pair [nm, value], but sample {index} is {value}"))
}

/// Samples of a table `nm,value`, each with the number of its line, from 1. `#` begins a comment; the first line may
/// be a heading.
fn samples_of_csv(text: &str) -> Result<Vec<(usize, [f64; 2])>, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let contents =
        text.lines().enumerate().map(|(index, line)| (index + 1, line.split('#').next().unwrap_or("").trim()));
    let mut samples = Vec::new();
    let mut heading_allowed = true;
    for (line, content) in contents.filter(|(_, content)| !content.is_empty()) {
        let fields: Vec<Option<f64>> = content.split(',').map(|field| field.trim().parse().ok()).collect();
        match fields[..] {
            [Some(nm), Some(value)] => samples.push((line, [nm, value])),
            [None, None] if heading_allowed => {}
            _ => {
                return Err(format!(
                    "line {line}: expected a wavelength in nm, a comma and a value, not \"{content}\""
                ));
            }
        }
        heading_allowed = false;
    }
    Ok(samples)
}

#[cfg(test)]
mod tests {
    //! Laws under test: a heading is not data, no line is lost, and a fault is reported with its own line. A wrong
    //! reader would take a heading for data or the reverse, lose a line, or name the wrong one.

    use super::*;

    #[test]
    fn comments_blank_lines_and_one_heading_are_skipped() {
        let text = "\u{feff}# measured\r\nwavelength,value\n\n400, 0.25 # violet\n 7e2,1\n";
        assert_eq!(samples_of_csv(text), Ok(vec![(4, [400.0, 0.25]), (5, [700.0, 1.0])]));
        assert_eq!(samples_of_csv("400,1"), Ok(vec![(1, [400.0, 1.0])]));
        assert_eq!(samples_of_csv("# nothing"), Ok(Vec::new()));
    }

    #[test]
    fn lines_that_are_no_pair_are_named() {
        let refused = |text: &str, line: &str| {
            let fault = samples_of_csv(text).unwrap_err();
            assert!(fault.starts_with(line), "{fault}");
        };
        refused("nm,value\nnm,value\n", "line 2:");
        refused("400,1\n\n500;2\n", "line 3:");
        refused("400,1\n500,2,3\n", "line 2:");
        refused("400\n", "line 1:");
        refused("400,x\n", "line 1:");
        refused("# a\n400,1\n500,\n", "line 3:");
    }
}
