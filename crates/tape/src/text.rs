//! Programs as ordinary text files: any line ends, a byte order mark, blank tape in between.

use crate::{END_OF_BLOCK, IGNORED, Reader};

const DELETE: u8 = 0x7F;

/// The reader for text files.
///
/// LF, CR LF and CR each end a line. NUL and DEL (blank and rubbed-out tape) and a byte order mark are passed over.
#[derive(Clone, Copy, Debug, Default)]
pub struct Text;

impl Reader for Text {
    fn translate(&self, bytes: &mut [u8], at: u64, last: bool) -> usize {
        if at == 0 {
            if !last && bytes.len() < 3 {
                return 0;
            }
            for mark in [&b"\xEF\xBB\xBF"[..], b"\xFF\xFE", b"\xFE\xFF"] {
                if bytes.starts_with(mark) {
                    bytes[..mark.len()].fill(IGNORED);
                }
            }
        }
        let mut from = 0;
        while let Some(found) = memchr::memchr2(b'\r', DELETE, &bytes[from..]) {
            let here = from + found;
            from = here + 1;
            bytes[here] = match (bytes[here], bytes.get(from)) {
                (DELETE, _) | (_, Some(b'\n')) => IGNORED,
                (_, None) if !last => return here,
                _ => END_OF_BLOCK,
            };
        }
        bytes.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(text: &[u8]) -> Vec<u8> {
        let mut bytes = text.to_vec();
        assert_eq!(Text.translate(&mut bytes, 0, true), bytes.len());
        bytes
    }

    /// The same text offered in chunks of `size`, what is not settled offered again.
    fn in_chunks(text: &[u8], size: usize) -> Vec<u8> {
        let mut out = Vec::new();
        while out.len() < text.len() {
            let mut take = size;
            loop {
                let end = (out.len() + take).min(text.len());
                let mut chunk = text[out.len()..end].to_vec();
                let settled = Text.translate(&mut chunk, out.len() as u64, end == text.len());
                if settled > 0 {
                    out.extend_from_slice(&chunk[..settled]);
                    break;
                }
                take += 1;
            }
        }
        out
    }

    #[test]
    fn every_line_end_is_one_end_of_block() {
        assert_eq!(whole(b"A\nB\r\nC\rD"), b"A\nB\0\nC\nD");
        assert_eq!(whole(b"A\r"), b"A\n");
        assert_eq!(whole(b"\r\r\n\n"), b"\n\0\n\n");
    }

    #[test]
    fn marks_and_rubbed_out_characters_are_passed_over() {
        assert_eq!(whole(b"\xEF\xBB\xBFG0"), b"\0\0\0G0");
        assert_eq!(whole(b"\xFF\xFEG\0"), b"\0\0G\0");
        assert_eq!(whole(b"G\x7F0"), b"G\x000");
    }

    #[test]
    fn chunks_of_any_size_give_the_same_characters() {
        let text = b"\xEF\xBB\xBF%\r\nO1\r\rG0\x7FX1\n\r\nM30\r";
        for size in 1..text.len() {
            assert_eq!(in_chunks(text, size), whole(text), "chunks of {size}");
        }
    }
}
