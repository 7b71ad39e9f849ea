//! One line of JSON as a complete tree: keys in their order, duplicate ones too.
//!
//! The tree of `serde_json` silently keeps only the last of two equal keys; a question must not be read that way.

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use crate::error::ProbeError;

/// A JSON value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum JsonNode {
    Null,
    Boolean(bool),
    Number(f64),
    Text(String),
    List(Vec<JsonNode>),
    Object(Vec<(String, JsonNode)>),
}

/// Parses a line.
///
/// Numbers are rounded to the nearest f64. A number too large for f64 is an error, and so is nesting deeper than
/// about a hundred brackets.
pub(super) fn parse(line: &str) -> Result<JsonNode, ProbeError> {
    serde_json::from_str(line).map_err(|error| {
        // The parser counts columns in bytes, and ends its sentence with the position.
        let column = error.column();
        let before = String::from_utf8_lossy(&line.as_bytes()[..column.min(line.len())]);
        let sentence = error.to_string();
        let reason = sentence.split(" at line ").next().unwrap_or_default().to_owned();
        ProbeError::NotJson { reason, column, near: last_characters(&before).to_owned() }
    })
}

/// End of a text, short enough to quote.
fn last_characters(text: &str) -> &str {
    const MOST: usize = 32;
    text.char_indices().rev().nth(MOST - 1).map_or(text, |(start, _)| &text[start..])
}

/// Text in quotation marks, cut if it is too long to quote.
pub(super) fn quoted(text: &str) -> String {
    const MOST: usize = 64;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{:?} and more", &text[..end]),
        None => format!("{text:?}"),
    }
}

impl fmt::Display for JsonNode {
    /// Writes a description of the value, for error messages.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => write!(f, "null"),
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Text(text) => write!(f, "the text {}", quoted(text)),
            Self::List(entries) => write!(f, "a list of {}", entries.len()),
            Self::Object(_) => write!(f, "an object"),
        }
    }
}

impl<'de> Deserialize<'de> for JsonNode {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(JsonNodeVisitor)
    }
}

struct JsonNodeVisitor;

impl<'de> Visitor<'de> for JsonNodeVisitor {
    type Value = JsonNode;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a JSON value")
    }

    fn visit_unit<E>(self) -> Result<JsonNode, E> {
        Ok(JsonNode::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<JsonNode, E> {
        Ok(JsonNode::Boolean(value))
    }

    fn visit_u64<E>(self, number: u64) -> Result<JsonNode, E> {
        Ok(JsonNode::Number(number as f64))
    }

    fn visit_i64<E>(self, number: i64) -> Result<JsonNode, E> {
        Ok(JsonNode::Number(number as f64))
    }

    fn visit_f64<E>(self, number: f64) -> Result<JsonNode, E> {
        Ok(JsonNode::Number(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<JsonNode, E> {
        Ok(JsonNode::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<JsonNode, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = list.next_element()? {
            entries.push(entry);
        }
        Ok(JsonNode::List(entries))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<JsonNode, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = object.next_entry()? {
            entries.push(entry);
        }
        Ok(JsonNode::Object(entries))
    }
}
