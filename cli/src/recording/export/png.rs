//! Images as PNG: in Foxglove's schemas, or as their type has them.
//!
//! Format: <https://www.w3.org/TR/png-3>, its data as stored blocks of <https://www.rfc-editor.org/rfc/rfc1951>: larger than
//! they could be, and every program reads them.

use serde_json::Value;

/// Largest stored block.
const BLOCK: usize = 0xffff;

/// No image is larger.
const PIXELS: u64 = 1 << 26;

/// A file.
pub(super) struct Image {
    pub(super) extension: String,
    pub(super) bytes: Vec<u8>,
}

/// The file of a `RawImage` or a `CompressedImage`.
pub(super) fn image(value: &Value) -> Option<Image> {
    let data = base64(value.get("data")?.as_str()?)?;
    if let Some(format) = value.get("format").and_then(Value::as_str) {
        let is_name = format.chars().all(|letter| letter.is_ascii_alphanumeric());
        return (is_name && !format.is_empty()).then(|| Image {
            extension: format.to_owned(),
            bytes: data,
        });
    }
    let number = |name: &str| value.get(name).and_then(Value::as_u64);
    let (width, height, step) = (number("width")?, number("height")?, number("step")?);
    let encoding = value.get("encoding")?.as_str()?;
    png((width, height), step, encoding, &data)
}

/// The file of a value of a type that is an image: these pixels, row by row, without gaps.
pub(super) fn typed(value: &Value, pixels: &str) -> Option<Image> {
    let number = |name: &str| value.get(name).and_then(Value::as_u64);
    let size @ (width, _) = (number("width")?, number("height")?);
    let (encoding, bytes) = match pixels {
        "gray" => ("mono8", 1),
        "rgb" => ("rgb8", 3),
        "yuyv" => ("yuyv", 2),
        _ => return None,
    };
    let data = value.get("data")?.as_array()?.iter();
    let data = data.map(|byte| u8::try_from(byte.as_u64()?).ok());
    let data: Vec<u8> = data.collect::<Option<_>>()?;
    png(size, width.checked_mul(bytes)?, encoding, &data)
}

fn png((width, height): (u64, u64), step: u64, encoding: &str, data: &[u8]) -> Option<Image> {
    if width == 0 || height == 0 || width.checked_mul(height)? > PIXELS {
        return None;
    }
    let rows = data.chunks_exact(usize::try_from(step).ok().filter(|step| *step > 0)?);
    let rows = rows.take(height as usize);
    let mut pixels = Vec::new();
    let mut count = 0;
    for row in rows {
        // No filter.
        pixels.push(0);
        push_row(&mut pixels, row, width as usize, encoding)?;
        count += 1;
    }
    (count == height).then(|| Image {
        extension: "png".to_owned(),
        bytes: encoded(width as u32, height as u32, &pixels),
    })
}

fn push_row(pixels: &mut Vec<u8>, row: &[u8], width: usize, encoding: &str) -> Option<()> {
    match encoding {
        "rgb8" => pixels.extend_from_slice(row.get(..width * 3)?),
        "bgr8" => {
            for pixel in row.get(..width * 3)?.chunks_exact(3) {
                pixels.extend(pixel.iter().rev());
            }
        }
        "mono8" | "8UC1" => {
            let row = row.get(..width)?.iter();
            row.for_each(|value| pixels.extend([*value; 3]));
        }
        "yuyv" | "yuv422_yuy2" => {
            for pair in row.get(..width.next_multiple_of(2) * 2)?.chunks_exact(4) {
                for luminance in [pair[0], pair[2]] {
                    pixels.extend(rgb(luminance, pair[1], pair[3]));
                }
            }
            pixels.truncate(pixels.len() - (width % 2) * 3);
        }
        _ => return None,
    }
    Some(())
}

/// Full-range BT.601.
fn rgb(y: u8, u: u8, v: u8) -> [u8; 3] {
    let (y, u, v) = (f32::from(y), f32::from(u) - 128.0, f32::from(v) - 128.0);
    // `as` saturates.
    [
        (y + 1.402 * v).round() as u8,
        (y - 0.344_14 * u - 0.714_14 * v).round() as u8,
        (y + 1.772 * u).round() as u8,
    ]
}

/// Colours of 8 bits each.
fn encoded(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut head = width.to_be_bytes().to_vec();
    head.extend(height.to_be_bytes());
    head.extend([8, 2, 0, 0, 0]);
    put_chunk(&mut file, b"IHDR", &head);
    put_chunk(&mut file, b"IDAT", &stored(pixels));
    put_chunk(&mut file, b"IEND", &[]);
    file
}

fn put_chunk(file: &mut Vec<u8>, kind: &[u8; 4], content: &[u8]) {
    file.extend((content.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(content);
    let sum = crc32fast::hash(&file[start..]);
    file.extend(sum.to_be_bytes());
}

/// A zlib stream that compresses nothing.
fn stored(bytes: &[u8]) -> Vec<u8> {
    let mut stream = vec![0x78, 0x01];
    let blocks = bytes.len().div_ceil(BLOCK);
    for (index, block) in bytes.chunks(BLOCK).enumerate() {
        let length = block.len() as u16;
        stream.push(u8::from(index + 1 == blocks));
        stream.extend(length.to_le_bytes());
        stream.extend((!length).to_le_bytes());
        stream.extend(block);
    }
    let (mut low, mut high) = (1_u32, 0_u32);
    for byte in bytes {
        low = (low + u32::from(*byte)) % 65521;
        high = (high + low) % 65521;
    }
    stream.extend((high << 16 | low).to_be_bytes());
    stream
}

/// RFC 4648.
fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=').as_bytes();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for letters in text.chunks(4) {
        let mut bits = 0_u32;
        for letter in letters {
            bits = bits << 6 | u32::from(six(*letter)?);
        }
        let missing = 4 - letters.len() as u32;
        let whole = (bits << (6 * missing)).to_be_bytes();
        bytes.extend(whole.get(1..letters.len())?);
    }
    Some(bytes)
}

fn six(letter: u8) -> Option<u8> {
    match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{base64, image};

    #[test]
    fn texts_of_base64_are_bytes() {
        for (text, bytes) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9vYmFy", "foobar"),
        ] {
            assert_eq!(base64(text).as_deref(), Some(bytes.as_bytes()));
        }
        assert_eq!(base64("Zg=!"), None);
    }

    #[test]
    fn what_is_no_image_is_none() {
        let value = json!({"width": 2, "height": 9, "step": 6, "encoding": "rgb8", "data": "AAAA"});
        assert!(image(&value).is_none(), "rows are missing");
        assert!(image(&json!({"x": 1})).is_none());
        let format = json!({"format": "../x", "data": ""});
        assert!(image(&format).is_none(), "it would be a path");
    }

    #[test]
    fn a_row_has_three_bytes_a_pixel() {
        let value =
            json!({"width": 2, "height": 1, "step": 4, "encoding": "yuyv", "data": "CoAUgA=="});
        let file = image(&value).expect("an image").bytes;
        let row = [0, 10, 10, 10, 20, 20, 20];
        assert!(file.windows(row.len()).any(|window| window == row));
        assert!(file.ends_with(b"IEND\xae\x42\x60\x82"));
    }
}
