//! JSON objects written into a byte buffer without building values first: a trace has millions of them.

/// Numbers up to this are exact in millionths.
const EXACT_MILLIONTHS: f64 = 9e15;

/// Appends a number with at most six decimals and no trailing noise; what is not finite becomes `null`.
pub fn push_number(out: &mut Vec<u8>, value: f64) {
    let millionths = (value * 1e6).round();
    if !millionths.is_finite() {
        out.extend_from_slice(b"null");
    } else if millionths.abs() < EXACT_MILLIONTHS {
        push_millionths(out, millionths as i64);
    } else {
        out.extend_from_slice(format!("{value:.0}").as_bytes());
    }
}

fn push_millionths(out: &mut Vec<u8>, millionths: i64) {
    if millionths < 0 {
        out.push(b'-');
    }
    let magnitude = millionths.unsigned_abs();
    push_integer(out, magnitude / 1_000_000);
    let mut rest = magnitude % 1_000_000;
    if rest == 0 {
        return;
    }
    out.push(b'.');
    let mut place = 100_000;
    while rest > 0 {
        out.push(b'0' + (rest / place) as u8);
        rest %= place;
        place /= 10;
    }
}

/// Appends a whole number.
pub(crate) fn push_integer(out: &mut Vec<u8>, value: u64) {
    let mut digits = [0u8; 20];
    let mut at = digits.len();
    let mut rest = value;
    loop {
        at -= 1;
        digits[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[at..]);
}

/// Appends a text in quotes.
pub(crate) fn push_text(out: &mut Vec<u8>, text: &str) {
    out.push(b'"');
    for byte in text.bytes() {
        match byte {
            b'"' | b'\\' => out.extend_from_slice(&[b'\\', byte]),
            0..0x20 => out.extend_from_slice(format!("\\u{byte:04x}").as_bytes()),
            _ => out.push(byte),
        }
    }
    out.push(b'"');
}

/// One JSON object, written field by field.
pub struct JsonLine<'o> {
    out: &'o mut Vec<u8>,
    first: bool,
    /// The items of a list, which have no names.
    list: bool,
}

impl<'o> JsonLine<'o> {
    /// Begins an object.
    pub fn begin(out: &'o mut Vec<u8>) -> JsonLine<'o> {
        out.push(b'{');
        JsonLine { out, first: true, list: false }
    }

    /// The buffer, with this field's name written; its value must follow.
    pub fn field(&mut self, name: &str) -> &mut Vec<u8> {
        if !self.first {
            self.out.push(b',');
        }
        self.first = false;
        if !self.list {
            push_text(self.out, name);
            self.out.push(b':');
        }
        self.out
    }

    /// A text.
    pub fn text(&mut self, name: &str, value: &str) -> &mut Self {
        push_text(self.field(name), value);
        self
    }

    /// A number.
    pub fn number(&mut self, name: &str, value: f64) -> &mut Self {
        push_number(self.field(name), value);
        self
    }

    /// A whole number.
    pub fn integer(&mut self, name: &str, value: u64) -> &mut Self {
        push_integer(self.field(name), value);
        self
    }

    /// True or false.
    pub fn boolean(&mut self, name: &str, value: bool) -> &mut Self {
        self.field(name).extend_from_slice(if value { b"true" } else { b"false" });
        self
    }

    /// A field without a value.
    pub fn null(&mut self, name: &str) -> &mut Self {
        self.field(name).extend_from_slice(b"null");
        self
    }

    /// An object inside.
    pub fn object(&mut self, name: &str, write: impl FnOnce(&mut JsonLine)) -> &mut Self {
        let out = self.field(name);
        let mut inner = JsonLine::begin(out);
        write(&mut inner);
        inner.end();
        self
    }

    /// A list; `write` writes each item as one field, whose name is left out.
    pub fn list<T>(&mut self, name: &str, items: &[T], write: impl Fn(&T, &mut JsonLine)) -> &mut Self {
        let out = self.field(name);
        out.push(b'[');
        let mut inner = JsonLine { out, first: true, list: true };
        items.iter().for_each(|item| write(item, &mut inner));
        inner.end();
        self
    }

    /// Ends the object.
    pub fn end(self) {
        self.out.push(if self.list { b']' } else { b'}' });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> String {
        let mut out = Vec::new();
        push_number(&mut out, value);
        String::from_utf8(out).expect("digits")
    }

    #[test]
    fn numbers_carry_no_noise() {
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(-0.000_000_4), "0");
        assert_eq!(number(-12.5), "-12.5");
        assert_eq!(number(1.000_000_5), "1.000001");
        assert_eq!(number(99_999.999), "99999.999");
        assert_eq!(number(1e20), "100000000000000000000");
        assert_eq!(number(f64::NAN), "null");
    }

    #[test]
    fn texts_are_escaped() {
        let mut out = Vec::new();
        let mut line = JsonLine::begin(&mut out);
        line.text("a", "x\"\\\n").integer("b", 0);
        line.end();
        assert_eq!(String::from_utf8(out).expect("text"), "{\"a\":\"x\\\"\\\\\\u000a\",\"b\":0}");
    }
}
