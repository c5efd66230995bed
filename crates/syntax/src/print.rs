//! A block back to text, without blanks and comments: parse → print → parse gives the same words.

use base::Decimal;

use crate::block::{Block, Value};

/// Writes the block's words and statement to `out`. `text` holds the block's own characters.
pub fn print_block(block: &Block, text: &[u8], out: &mut Vec<u8>) {
    if block.rewind {
        out.push(b'%');
    }
    let mut skips = block.skips.iter().peekable();
    let mut print_skips = |before: usize, out: &mut Vec<u8>| {
        while let Some(skip) = skips.next_if(|skip| usize::from(skip.first_word) <= before) {
            out.push(b'/');
            // Where the sign stands at the head only, it has no number.
            if skip.switch != 1 {
                out.push(b'0' + skip.switch);
            }
        }
    };
    for (index, word) in block.words.iter().enumerate() {
        print_skips(index, out);
        out.push(word.letter);
        match word.value {
            Value::Number(number) => print_number(number, out),
            Value::Expression => {
                let from = usize::from(word.extent.at) + 1;
                let to = usize::from(word.extent.at) + usize::from(word.extent.len);
                out.extend(text.get(from..to).unwrap_or_default().iter().filter(|&&b| b != 0));
            }
            Value::Missing => {}
        }
        // The name stands behind its code, between blanks.
        let next = block.words.get(index + 1).map_or(u16::MAX, |next| next.extent.at);
        if let Some(name) = block.call_name.filter(|name| (word.extent.at..next).contains(&name.at)) {
            let (from, to) = (usize::from(name.at), usize::from(name.at) + usize::from(name.len));
            out.push(b' ');
            out.extend_from_slice(text.get(from..to).unwrap_or_default());
            out.push(b' ');
        }
    }
    print_skips(usize::MAX, out);
    if let Some(statement) = block.statement {
        let from = usize::from(statement.extent.at);
        let to = from + usize::from(statement.extent.len);
        out.extend(text.get(from..to).unwrap_or_default().iter().filter(|&&b| b != 0));
    }
}

fn print_number(number: Decimal, out: &mut Vec<u8>) {
    let Decimal { mantissa, decimals, digits, point, negative } = number;
    if negative {
        out.push(b'-');
    }
    let width = usize::from(digits) + usize::from(decimals);
    let text = format!("{mantissa:0width$}");
    let split = text.len() - usize::from(decimals);
    // A number without any digit before the point keeps that shape.
    out.extend_from_slice(&text.as_bytes()[..split]);
    if point {
        out.push(b'.');
    }
    out.extend_from_slice(&text.as_bytes()[split..]);
}
