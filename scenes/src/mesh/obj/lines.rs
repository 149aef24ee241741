//! The lines of a text as the format means them: `#` ends a line anywhere, and a
//! `\` at the end continues it.

use std::borrow::Cow;

/// Logical lines that say something, each with the number (from 1) of the line of
/// text where it begins.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut physical = bytes.split(|byte| *byte == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (index, first) = physical.next()?;
        let (mut text, mut goes_on) = said(first);
        while goes_on {
            let Some((_, next)) = physical.next() else { break };
            let (more, again) = said(next);
            text = Cow::Owned(format!("{text} {more}"));
            goes_on = again;
        }
        Some((index + 1, text))
    })
    .filter(|(_, text)| !text.trim().is_empty())
}

/// What a line of text says, and whether the next one goes on with it. A `\`
/// within a comment is part of the comment.
fn said(line: &[u8]) -> (Cow<'_, str>, bool) {
    let end = line.iter().position(|byte| *byte == b'#').unwrap_or(line.len());
    let said = line[..end].trim_ascii_end();
    match said.strip_suffix(b"\\") {
        Some(said) => (String::from_utf8_lossy(said), true),
        None => (String::from_utf8_lossy(said), false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_end_lines_and_a_backslash_goes_on() {
        let text = "f 1 2 \\\r\n 3 # front\n# C:\\models\\\nv 0 0 0\n\nl 1 2 \\ \n\\\n 3\nf \\";
        let found: Vec<(usize, String)> = lines(text.as_bytes())
            .map(|(number, text)| (number, text.split_whitespace().collect::<Vec<_>>().join(" ")))
            .collect();
        let wanted = [(1, "f 1 2 3"), (4, "v 0 0 0"), (6, "l 1 2 3"), (9, "f")];
        assert_eq!(found, wanted.map(|(number, text)| (number, text.to_owned())));
    }
}
