//! GDAL's own metadata: a text of XML whose items say what samples mean.

use super::directory::{Directory, Tiff, tag};

/// What items of the first band say.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Metadata {
    pub(super) scale: Option<f64>,
    pub(super) offset: Option<f64>,
    /// Name of the unit of heights.
    pub(super) unit: Option<String>,
}

/// Reads the metadata of an image; none is no error.
pub(super) fn read(tiff: &Tiff<'_>, directory: &Directory) -> Metadata {
    let Ok(Some(text)) = tiff.text(directory, tag::GDAL_METADATA) else {
        return Metadata::default();
    };
    parse(&String::from_utf8_lossy(text))
}

fn parse(text: &str) -> Metadata {
    let mut found = Metadata::default();
    for item in text.split("<Item").skip(1) {
        let Some((attributes, rest)) = item.split_once('>') else { continue };
        let value = rest.split('<').next().unwrap_or_default().trim();
        // Items of the whole file and of other bands say nothing of this one.
        if attribute(attributes, "sample") != Some("0") {
            continue;
        }
        let number = || number_at_the_head(value);
        match attribute(attributes, "role").unwrap_or_default() {
            "scale" => found.scale = number(),
            "offset" => found.offset = number(),
            "unittype" if !value.is_empty() => found.unit = Some(unescaped(value)),
            _ => {}
        }
    }
    found
}

/// The number that a text begins with, as C programs read it.
fn number_at_the_head(text: &str) -> Option<f64> {
    let end = text.find(|c: char| !c.is_ascii_digit() && !"+-.eE".contains(c));
    let head = &text[..end.unwrap_or(text.len())];
    // "1e" of "1em" is 1.
    let mut heads = (1..=head.len()).rev().map(|length| &head[..length]);
    heads.find_map(|head| head.parse::<f64>().ok()).filter(|number| number.is_finite())
}

/// The value of an attribute in either kind of quotes.
fn attribute<'a>(attributes: &'a str, name: &str) -> Option<&'a str> {
    let (_, after) = attributes.split_once(&format!("{name}="))?;
    let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    after[1..].split(quote).next()
}

fn unescaped(text: &str) -> String {
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_of_the_first_band() {
        let text = "<GDALMetadata>\n  <Item name=\"AREA\">1</Item>\n  <Item name=\"OFFSET\" sample=\"0\" \
                    role=\"offset\">-100</Item>\n  <Item name='SCALE' sample='0' role='scale'>0.1 m</Item>\n\
                    <Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">US survey foot</Item>\n\
                    <Item name=\"SCALE\" sample=\"1\" role=\"scale\">7</Item>\
                    <Item name=\"SCALE\" role=\"scale\">8</Item></GDALMetadata>";
        assert_eq!(
            parse(text),
            Metadata {
                scale: Some(0.1),
                offset: Some(-100.0),
                unit: Some("US survey foot".to_owned())
            }
        );
        for text in
            ["", "<Item", "<Item role=\"scale\">nan</Item>", "<Item role=>x", "<Item role=é"]
        {
            assert_eq!(parse(text), Metadata::default(), "{text}");
        }
    }
}
