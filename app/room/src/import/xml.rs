//! XML reading that ignores upper and lower case, in which the writing programs differ.

use roxmltree::{Document, Node};

/// Parses a document whose root is called `root`.
pub(super) fn document<'a>(text: &'a str, root: &str) -> Result<Document<'a>, String> {
    regular_file::check_xml(text).map_err(|excess| excess.to_string())?;
    let document = Document::parse(text).map_err(|error| format!("it is no XML: {error}"))?;
    let name = document.root_element().tag_name().name();
    if !name.eq_ignore_ascii_case(root) {
        return Err(format!("its root is <{name}>, not <{root}>"));
    }
    Ok(document)
}

/// Elements called `name` below a node, at any depth.
pub(super) fn all<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |node| node.is_element() && node.tag_name().name().eq_ignore_ascii_case(name))
}

/// Elements called `name` directly below a node.
pub(super) fn children<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |node| node.is_element() && node.tag_name().name().eq_ignore_ascii_case(name))
}

/// First element called `name` below a node, at any depth.
pub(super) fn first<'a>(node: Node<'a, 'a>, name: &'static str) -> Option<Node<'a, 'a>> {
    all(node, name).find(|found| *found != node)
}

/// Text of the first element called `name`, without surrounding space; `None` if it is empty.
pub(super) fn text<'a>(node: Node<'a, 'a>, name: &'static str) -> Option<&'a str> {
    first(node, name)?.text().map(str::trim).filter(|text| !text.is_empty())
}

/// Value of an attribute, without surrounding space.
pub(super) fn attribute<'a>(node: Node<'a, 'a>, name: &str) -> Option<&'a str> {
    node.attributes()
        .find(|attribute| attribute.name().eq_ignore_ascii_case(name))
        .map(|attribute| attribute.value().trim())
}

/// Finite number in an attribute that must be there.
pub(super) fn number(node: Node<'_, '_>, name: &str) -> Result<f64, String> {
    let value = node.attributes().find(|attribute| attribute.name().eq_ignore_ascii_case(name));
    let value = value.ok_or_else(|| format!("{}: it has no {name}", place(node)))?.value();
    let number = value.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("{}: {name} = {value:?} is no number", place(node)))
}

/// Line and name of an element, for errors.
pub(super) fn place(node: Node<'_, '_>) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    format!("line {line}, <{}>", node.tag_name().name())
}
