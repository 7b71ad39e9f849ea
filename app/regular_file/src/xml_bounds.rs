//! Bounds of XML text, checked before it is parsed: parsers compare the attributes of an element with one another, and
//! hand the namespaces of an element down to all within it.

use thiserror::Error;

/// Most attributes of one element.
const MOST_ATTRIBUTES: usize = 1000;
/// Most declarations of namespaces in a text.
const MOST_NAMESPACES: usize = 1000;

/// XML that would take too long to parse. The text is worded to follow the file's name.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum ExcessiveXml {
    /// An element with too many attributes.
    #[error("it is no usable XML: an element has more than {MOST_ATTRIBUTES} attributes")]
    Attributes,
    /// A text with too many namespaces.
    #[error("it is no usable XML: it declares more than {MOST_NAMESPACES} namespaces")]
    Namespaces,
}

/// Checks that a text can be parsed in a time in proportion to its length. Whether it is XML is left to the parser.
///
/// # Errors
/// [`ExcessiveXml`].
pub fn check_xml(text: &str) -> Result<(), ExcessiveXml> {
    if text.matches("xmlns").nth(MOST_NAMESPACES).is_some() {
        return Err(ExcessiveXml::Namespaces);
    }
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        // Comments, plain text and instructions have no attributes, but may have anything that looks like them.
        let skipped =
            [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")].into_iter().find(|(from, _)| rest.starts_with(from));
        if let Some((from, to)) = skipped {
            let Some(end) = rest[from.len()..].find(to) else { return Ok(()) };
            rest = &rest[from.len() + end + to.len()..];
            continue;
        }
        let (mut quote, mut attributes, mut end) = (None, 0, rest.len());
        for (at, byte) in rest.bytes().enumerate().skip(1) {
            match (quote, byte) {
                (Some(open), _) if open == byte => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => attributes += 1,
                (None, b'>') => {
                    end = at + 1;
                    break;
                }
                _ => {}
            }
        }
        if attributes > MOST_ATTRIBUTES {
            return Err(ExcessiveXml::Attributes);
        }
        rest = &rest[end..];
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    //! Law: what an ordinary file has is let through, however long; what makes parsers slow is refused.
    use super::*;

    #[test]
    fn elements_with_very_many_attributes_are_refused_and_no_others() {
        let attributes = |count: usize| (0..count).map(|n| format!(" a{n}='=>'")).collect::<String>();
        assert_eq!(check_xml(&format!("<a><b{}/></a>", attributes(MOST_ATTRIBUTES))), Ok(()));
        assert_eq!(check_xml(&format!("<a><b{}/></a>", attributes(100_000))), Err(ExcessiveXml::Attributes));
        let many = format!("<a>{}</a>", format!("<b{}/>", attributes(10)).repeat(10_000));
        assert_eq!(check_xml(&many), Ok(()));
        let equals = "=".repeat(5000);
        for text in [format!("<!-- {equals} -->"), format!("<![CDATA[ {equals} ]]>"), format!("<?x {equals} ?>")] {
            assert_eq!(check_xml(&format!("<a>{text}{equals}<b c=\"{equals}\"/></a>")), Ok(()), "{}", &text[..9]);
        }
    }

    #[test]
    fn namespaces_within_namespaces_are_bounded() {
        let nested = |count: usize| (0..count).map(|n| format!("<a xmlns:n{n}='u{n}'>")).collect::<String>();
        assert_eq!(check_xml(&nested(MOST_NAMESPACES)), Ok(()));
        assert_eq!(check_xml(&nested(60_000)), Err(ExcessiveXml::Namespaces));
    }

    #[test]
    fn broken_text_is_left_to_the_parser() {
        for text in ["", "<", "<a b='", "<!--", "<?x", "ü<ü ü='ü'>", "<![CDATA["] {
            assert_eq!(check_xml(text), Ok(()));
        }
    }
}
