//! Reading XML files, through the crate roxmltree, with failures that name line and element.

use std::borrow::Cow;

use roxmltree::{Document, Node};

use crate::error::{Error, ErrorKind, Result};
use crate::whole_file::line_of;

/// At most 2^23 tags: roxmltree reserves about 100 bytes per `<` before it parses, and about 80 per `=`.
const MAX_TAGS: usize = 1 << 23;

/// At most 4096 attributes per element: roxmltree compares each with all before it.
const MAX_ATTRIBUTES: usize = 1 << 12;

/// At most 256 namespaces: roxmltree copies those of an element to each child that declares another.
const MAX_NAMESPACES: usize = 1 << 8;

/// Parses a document. A document type, and so entities, are refused: the formats read here have none.
pub fn parse(text: &str) -> Result<Document<'_>> {
    require_parseable(text)?;
    Document::parse(text).map_err(|fault| Error::new(ErrorKind::Parse, with_line(text, &fault)))
}

/// What the parser found wrong. Of what is missing at the end, and of document types, it does not say where.
fn with_line(text: &str, fault: &roxmltree::Error) -> String {
    use roxmltree::Error::{DtdDetected, NoRootNode, UnclosedRootNode, UnexpectedEndOfStream};
    let place = match fault {
        DtdDetected => text.find("<!DOCTYPE").unwrap_or(0),
        NoRootNode | UnclosedRootNode | UnexpectedEndOfStream => text.trim_end().len(),
        _ => return fault.to_string(),
    };
    format!("line {}: {fault}", line_of(text.as_bytes(), place))
}

/// Refuses texts for which the parser's time or memory would be out of proportion to their length.
fn require_parseable(text: &str) -> Result<()> {
    let refused = |message: String| Err(Error::new(ErrorKind::Unsupported, message));
    let count = |byte: u8, text: &str| text.bytes().filter(|&b| b == byte).count();
    if count(b'<', text).max(count(b'=', text)) > MAX_TAGS {
        return refused(format!("more than {MAX_TAGS} elements or attributes"));
    }
    if text.matches("xmlns").count() > MAX_NAMESPACES {
        return refused(format!("more than {MAX_NAMESPACES} namespaces"));
    }
    let mut end = 0;
    for part in text.split('<') {
        // The attributes of an element end before the next `<`.
        let is_element = end > 0 && !part.starts_with(['!', '?', '/']);
        if is_element && count(b'=', part) > MAX_ATTRIBUTES {
            let line = line_of(text.as_bytes(), end);
            return refused(format!(
                "line {line}: an element has more than {MAX_ATTRIBUTES} attributes"
            ));
        }
        end += part.len() + 1;
    }
    Ok(())
}

/// The text of an element itself, whatever comments stand in it.
pub fn text_in<'a>(node: Node<'a, '_>) -> Cow<'a, str> {
    let mut texts = node
        .children()
        .filter(Node::is_text)
        .filter_map(|part| part.text());
    let first = texts.next().unwrap_or_default();
    match texts.next() {
        None => Cow::Borrowed(first),
        Some(second) => Cow::Owned([first, second].into_iter().chain(texts).collect()),
    }
}

/// The place of an element: `line 12, <origin>`.
pub fn place(node: Node) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    format!("line {line}, <{}>", node.tag_name().name())
}

pub fn fault(node: Node, kind: ErrorKind, message: impl std::fmt::Display) -> Error {
    Error::new(kind, format!("{}: {message}", place(node)))
}

/// Refuses an element with what is left of macros that were not expanded.
pub fn require_expanded(node: Node) -> Result<()> {
    if node
        .tag_name()
        .namespace()
        .is_some_and(|name| name.contains("xacro"))
    {
        let message = "a raw xacro macro: expand the macros first";
        return Err(fault(node, ErrorKind::Parse, message));
    }
    if let Some(raw) = node.attributes().find(|name| name.value().contains("${")) {
        let (name, value) = (raw.name(), raw.value());
        let message = format!("{name} \"{value}\" is raw xacro: expand the macros first");
        return Err(fault(node, ErrorKind::Parse, message));
    }
    Ok(())
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

/// Exactly N finite numbers, separated by white space.
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

/// All numbers of a text, separated by white space.
pub fn list<T: std::str::FromStr>(node: Node, what: &str, text: &str) -> Result<Vec<T>> {
    let mut found = Vec::new();
    let count = text.split_ascii_whitespace().count();
    let reserved = found.try_reserve_exact(count);
    reserved.map_err(|e| Error::memory(e).within(place(node)))?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_names_its_line() {
        let whole = "<robot>\n<link name='a'>\n</link></robot>";
        assert!(parse(whole).is_ok());
        for (text, line) in [
            ("", "line 1"),
            ("<robot>\n<link>\n</link>\n\n", "line 3"),
            ("<robot>\n<link", "line 2"),
            ("\n\n<!DOCTYPE robot><robot/>", "line 3"),
            ("<robot>\n</link>", " 2:1"),
        ] {
            let message = parse(text).unwrap_err().message;
            assert!(message.contains(line), "{text:?}: {message}");
        }
    }
}
