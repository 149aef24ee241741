//! What a TIFF file says beside its pixels.

use tiff::decoder::Decoder;
use tiff::tags::Tag;

/// Tags that the pixels alone do not tell.
#[derive(Debug, Default)]
pub(super) struct Tags {
    /// Colours are multiplied by their opacity (ExtraSamples 1).
    pub(super) is_multiplied: bool,
    pub(super) warnings: Vec<String>,
}

/// Reads them from the first image of the file. What cannot be read is left to
/// the decoder of the pixels, which says so.
///
/// Source: TIFF 6.0, Adobe 1992, section 18.
pub(super) fn tags(bytes: &[u8]) -> Tags {
    let mut tags = Tags::default();
    let Ok(mut decoder) = Decoder::new(std::io::Cursor::new(bytes)) else { return tags };
    let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples);
    match extra.ok().flatten().as_deref() {
        Some([1, ..]) => tags.is_multiplied = true,
        Some([0, ..]) => tags
            .warnings
            .push("its fourth channel is not said to be alpha; it is taken as that".to_owned()),
        _ => {}
    }
    if decoder.more_images() {
        tags.warnings.push("it holds several images: the first is taken".to_owned());
    }
    tags
}
