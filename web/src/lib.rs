//! The files of the page, embedded so that they are wherever the program is.
//!
//! `dist/` holds them as a browser gets them; there is no build step and no dependency.

/// A file as a server hands it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct File {
    pub bytes: &'static [u8],
    /// For the header `Content-Type`.
    pub media_type: &'static str,
}

/// Every file by its path below the root of the page, sorted.
const FILES: &[(&str, File)] = &[
    (
        "favicon.svg",
        File {
            bytes: include_bytes!("../dist/favicon.svg"),
            media_type: "image/svg+xml",
        },
    ),
    (
        "graph.html",
        File {
            bytes: include_bytes!("../dist/graph.html"),
            media_type: "text/html; charset=utf-8",
        },
    ),
    (
        "graph.js",
        File {
            bytes: include_bytes!("../dist/graph.js"),
            media_type: "text/javascript; charset=utf-8",
        },
    ),
];

/// The file at this path, written without a leading slash.
pub fn file(path: &str) -> Option<File> {
    FILES
        .iter()
        .find(|(name, _)| *name == path)
        .map(|(_, file)| *file)
}

#[cfg(test)]
mod tests {
    use super::{FILES, file};

    #[test]
    fn every_file_of_the_folder_is_embedded() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/dist");
        let mut names: Vec<String> = std::fs::read_dir(folder)
            .expect("the folder is part of the crate")
            .map(|entry| {
                entry
                    .expect("it can be read")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        let embedded: Vec<&str> = FILES.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, embedded);
    }

    #[test]
    fn a_page_asks_the_network_for_nothing() {
        let page = file("graph.html").expect("it is embedded");
        let text = std::str::from_utf8(page.bytes).expect("it is text");
        assert!(!text.contains("http:") && !text.contains("https:"));
        assert_eq!(page.media_type, "text/html; charset=utf-8");
        assert_eq!(file("/graph.html"), None);
    }
}
