//! Reading XML files, through the crate roxmltree, with failures that name line and element.

use roxmltree::{Document, Node};

use crate::error::{Error, ErrorKind, Result};

/// A document of a file's bytes.
pub fn text_of(bytes: &[u8]) -> Result<&str> {
    std::str::from_utf8(bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()]
            .iter()
            .filter(|&&b| b == b'\n')
            .count();
        Error::new(ErrorKind::Parse, format!("line {line}: not UTF-8"))
    })
}

pub fn parse(text: &str) -> Result<Document<'_>> {
    Document::parse(text).map_err(|e| Error::new(ErrorKind::Parse, e.to_string()))
}

/// Where an element stands: `line 12, <origin>`.
pub fn place(node: Node) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    format!("line {line}, <{}>", node.tag_name().name())
}

pub fn fault(node: Node, kind: ErrorKind, message: impl std::fmt::Display) -> Error {
    Error::new(kind, format!("{}: {message}", place(node)))
}

/// The children of this name, whatever their namespace.
pub fn children<'a, 'i>(node: Node<'a, 'i>, name: &str) -> impl Iterator<Item = Node<'a, 'i>> {
    let elements = node.children().filter(Node::is_element);
    elements.filter(move |child| child.tag_name().name() == name)
}

/// The first child of this name.
pub fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    children(node, name).next()
}

pub fn required_child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Result<Node<'a, 'i>> {
    child(node, name).ok_or_else(|| fault(node, ErrorKind::Parse, format!("it has no <{name}>")))
}

pub fn required<'a>(node: Node<'a, '_>, attribute: &str) -> Result<&'a str> {
    node.attribute(attribute).ok_or_else(|| {
        let message = format!("it has no attribute \"{attribute}\"");
        fault(node, ErrorKind::Parse, message)
    })
}

/// Exactly N finite numbers, apart by blanks.
pub fn numbers<const N: usize>(node: Node, what: &str, text: &str) -> Result<[f64; N]> {
    let found = list::<f64>(node, what, text)?;
    let count = found.len();
    let values: [f64; N] = found.try_into().map_err(|_| {
        fault(
            node,
            ErrorKind::Parse,
            format!("{what} has {count} numbers, not {N}: \"{text}\""),
        )
    })?;
    match values.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(fault(
            node,
            ErrorKind::NotFinite,
            format!("{what} holds {x}"),
        )),
        None => Ok(values),
    }
}

/// All numbers of a text.
pub fn list<T: std::str::FromStr>(node: Node, what: &str, text: &str) -> Result<Vec<T>> {
    let mut found = Vec::new();
    for word in text.split_ascii_whitespace() {
        found.push(word.parse().map_err(|_| {
            fault(
                node,
                ErrorKind::Parse,
                format!("{what}: \"{word}\" is not a number that belongs here"),
            )
        })?);
    }
    Ok(found)
}
