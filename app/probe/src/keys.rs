//! Typed values from a question's tree, each with the path that an error message gives.

use std::collections::HashSet;

use glam::DVec3;
use physics::colour::{Spectrum, SpectrumError};
use physics::{Beta, Celerity, CelerityError, Event, Observer};

use crate::error::ProbeError;
use crate::json::{JsonNode, quoted};

const NUMBER: &str = "a number";
const VECTOR: &str = "a list of three numbers [x, y, z]";
const DIRECTION: &str = "a direction: a list of three numbers [x, y, z], not all zero";
const VELOCITY: &str = "a celerity, three numbers [x, y, z] (or the key \"beta\" instead)";
const OBSERVER: &str = "an object with the keys position, time (default 0), celerity or beta";
const SOURCE: &str = "an object with the keys position, celerity or beta";
const SPECTRUM: &str = "an object with one of the keys planck, sampled, rgb";
const SAMPLES: &str = "a list of samples [wavelength in nm, value]";
const SAMPLE: &str = "a sample: a list of two numbers [wavelength in nm, value]";
const COLOUR: &str = "a list of three numbers [red, green, blue]";
const OBJECT: &str = "an object";

/// A value and its path in the question.
pub(super) struct QuestionValue<'a> {
    path: String,
    node: &'a JsonNode,
}

/// An object in the question, without duplicate keys.
pub(super) struct QuestionKeys<'a> {
    path: String,
    entries: &'a [(String, JsonNode)],
}

impl<'a> QuestionValue<'a> {
    pub(super) fn wrong(&self, expected: &'static str) -> ProbeError {
        ProbeError::Wrong { key: self.path.clone(), found: self.node.to_string(), expected }
    }

    pub(super) fn number(&self) -> Result<f64, ProbeError> {
        match self.node {
            JsonNode::Number(number) => Ok(*number),
            _ => Err(self.wrong(NUMBER)),
        }
    }

    /// Number for which `accepts` is true.
    pub(super) fn number_that(&self, accepts: impl Fn(f64) -> bool, expected: &'static str) -> Result<f64, ProbeError> {
        self.number().ok().filter(|number| accepts(*number)).ok_or_else(|| self.wrong(expected))
    }

    pub(super) fn text(&self, expected: &'static str) -> Result<&'a str, ProbeError> {
        match self.node {
            JsonNode::Text(text) => Ok(text),
            _ => Err(self.wrong(expected)),
        }
    }

    /// Entries of a list of any length.
    pub(super) fn list(&self, expected: &'static str) -> Result<Vec<QuestionValue<'a>>, ProbeError> {
        let JsonNode::List(entries) = self.node else { return Err(self.wrong(expected)) };
        Ok(entries.iter().enumerate().map(|(index, node)| self.entry(index, node)).collect())
    }

    /// Entries of a list of this length.
    pub(super) fn list_of<const N: usize>(&self, expected: &'static str) -> Result<[QuestionValue<'a>; N], ProbeError> {
        match self.node {
            JsonNode::List(entries) if entries.len() == N => {
                Ok(std::array::from_fn(|index| self.entry(index, &entries[index])))
            }
            _ => Err(self.wrong(expected)),
        }
    }

    fn entry(&self, index: usize, node: &'a JsonNode) -> Self {
        Self { path: format!("{}[{index}]", self.path), node }
    }

    pub(super) fn vector(&self) -> Result<DVec3, ProbeError> {
        self.numbers(VECTOR).map(DVec3::from_array)
    }

    /// Vector of which only the direction counts, scaled to a length whose square neither overflows nor vanishes.
    pub(super) fn direction(&self) -> Result<DVec3, ProbeError> {
        /// Scale 2⁶⁰⁰: a power of two, so that nothing is rounded.
        const STRETCH: f64 = f64::from_bits((1023 + 600) << 52);
        const SHORT: f64 = 1e-150;
        let vector = self.vector()?;
        match vector.abs().max_element() {
            0.0 => Err(ProbeError::Wrong { key: self.path.clone(), found: "zero".to_owned(), expected: DIRECTION }),
            largest if largest < SHORT => Ok(vector * STRETCH),
            largest if largest > 1.0 / SHORT => Ok(vector / STRETCH),
            _ => Ok(vector),
        }
    }

    /// Object that has only the known keys.
    pub(super) fn object(&self, expected: &'static str, known: &[&str]) -> Result<QuestionKeys<'a>, ProbeError> {
        let JsonNode::Object(entries) = self.node else { return Err(self.wrong(expected)) };
        let keys = QuestionKeys::new(self.path.clone(), entries)?;
        keys.only(known)?;
        Ok(keys)
    }

    fn velocity_from(&self, convert: fn(DVec3) -> Result<Celerity, CelerityError>) -> Result<Celerity, ProbeError> {
        convert(self.vector()?).map_err(|reason| ProbeError::Velocity { key: self.path.clone(), reason })
    }

    /// Velocity under its own key. Three numbers are a celerity; an object has the key `celerity` or `beta`.
    pub(super) fn velocity(&self) -> Result<Celerity, ProbeError> {
        match self.node {
            JsonNode::Object(_) => self.object(OBJECT, &["celerity", "beta"])?.velocity(),
            _ => self.velocity_from(Celerity::new),
        }
    }

    fn numbers<const N: usize>(&self, expected: &'static str) -> Result<[f64; N], ProbeError> {
        let mut numbers = [0.0; N];
        for (number, place) in numbers.iter_mut().zip(self.list_of::<N>(expected)?) {
            *number = place.number()?;
        }
        Ok(numbers)
    }

    fn spectrum_from(&self, spectrum: Result<Spectrum, SpectrumError>) -> Result<Spectrum, ProbeError> {
        spectrum.map_err(|reason| ProbeError::Spectrum { key: self.path.clone(), reason })
    }

    /// Spectrum, of the kind given by its only key.
    pub(super) fn spectrum(&self) -> Result<Spectrum, ProbeError> {
        const KINDS: [&str; 3] = ["planck", "sampled", "rgb"];
        let keys = self.object(SPECTRUM, &KINDS)?;
        match KINDS.map(|kind| keys.optional(kind)) {
            [Some(kelvin), None, None] => kelvin.spectrum_from(Spectrum::planck(kelvin.number()?)),
            [None, Some(list), None] => {
                let samples = list.list(SAMPLES)?;
                let samples: Result<Vec<_>, _> = samples.iter().map(|sample| sample.numbers(SAMPLE)).collect();
                list.spectrum_from(Spectrum::sampled(samples?))
            }
            [None, None, Some(colour)] => colour.spectrum_from(Spectrum::rgb(colour.numbers(COLOUR)?)),
            _ => Err(self.wrong(SPECTRUM)),
        }
    }

    pub(super) fn observer(&self) -> Result<Observer, ProbeError> {
        let keys = self.object(OBSERVER, &["position", "time", "celerity", "beta"])?;
        let ct = keys.optional("time").map_or(Ok(0.0), |time| time.number())?;
        let position = keys.required("position", VECTOR)?.vector()?;
        Ok(Observer { event: Event { ct, position }, celerity: keys.velocity()? })
    }
}

impl<'a> QuestionKeys<'a> {
    /// Keys of the whole line.
    pub(super) fn of_line(node: &'a JsonNode) -> Result<Self, ProbeError> {
        match node {
            JsonNode::Object(entries) => Self::new(String::new(), entries),
            _ => Err(ProbeError::NotAnObject { found: node.to_string() }),
        }
    }

    fn new(path: String, entries: &'a [(String, JsonNode)]) -> Result<Self, ProbeError> {
        let keys = Self { path, entries };
        let mut seen = HashSet::new();
        match entries.iter().find(|(key, _)| !seen.insert(key)) {
            Some((key, _)) => Err(ProbeError::Doubled { key: keys.path_of(key) }),
            None => Ok(keys),
        }
    }

    /// Fails if there is any key but these.
    pub(super) fn only(&self, known: &[&str]) -> Result<(), ProbeError> {
        match self.entries.iter().find(|(key, _)| !known.contains(&key.as_str())) {
            Some((key, _)) => Err(ProbeError::Unknown { key: self.path_of(key), known: known.join(", ") }),
            None => Ok(()),
        }
    }

    pub(super) fn optional(&self, key: &str) -> Option<QuestionValue<'a>> {
        let (_, node) = self.entries.iter().find(|(name, _)| name == key)?;
        Some(QuestionValue { path: self.path_of(key), node })
    }

    pub(super) fn required(&self, key: &str, expected: &'static str) -> Result<QuestionValue<'a>, ProbeError> {
        self.optional(key).ok_or_else(|| ProbeError::Missing { key: self.path_of(key), expected })
    }

    pub(super) fn number(&self, key: &str) -> Result<f64, ProbeError> {
        self.required(key, NUMBER)?.number()
    }

    pub(super) fn direction(&self, key: &str) -> Result<DVec3, ProbeError> {
        self.required(key, DIRECTION)?.direction()
    }

    pub(super) fn vector(&self, key: &str) -> Result<DVec3, ProbeError> {
        self.required(key, VECTOR)?.vector()
    }

    pub(super) fn spectrum(&self, key: &str) -> Result<Spectrum, ProbeError> {
        self.required(key, SPECTRUM)?.spectrum()
    }

    /// Keys of a source.
    pub(super) fn source(&self, key: &str) -> Result<QuestionKeys<'a>, ProbeError> {
        self.required(key, SOURCE)?.object(SOURCE, &["position", "celerity", "beta"])
    }

    pub(super) fn observer(&self, key: &str) -> Result<Observer, ProbeError> {
        self.required(key, OBSERVER)?.observer()
    }

    /// Velocity from `celerity` or from `beta`, if one of them is there.
    pub(super) fn optional_velocity(&self) -> Result<Option<Celerity>, ProbeError> {
        match (self.optional("celerity"), self.optional("beta")) {
            (Some(celerity), Some(beta)) => Err(ProbeError::TwoVelocities { celerity: celerity.path, beta: beta.path }),
            (Some(celerity), None) => celerity.velocity_from(Celerity::new).map(Some),
            (None, Some(beta)) => beta.velocity_from(|vector| Beta::new(vector).map(Beta::celerity)).map(Some),
            (None, None) => Ok(None),
        }
    }

    /// Velocity from `celerity` or from `beta`.
    pub(super) fn velocity(&self) -> Result<Celerity, ProbeError> {
        let missing = || ProbeError::Missing { key: self.path_of("celerity"), expected: VELOCITY };
        self.optional_velocity()?.ok_or_else(missing)
    }

    fn path_of(&self, key: &str) -> String {
        let plain = key.chars().all(|character| character.is_ascii_alphanumeric() || character == '_');
        let key = if plain && key.len() <= 64 { key.to_owned() } else { quoted(key) };
        if self.path.is_empty() { key } else { format!("{}.{key}", self.path) }
    }
}
