//! The files of hulkgen's pages, embedded so that they are wherever the program is.
//!
//! `dist/` holds the page of a running robot as `npm run build` in `page/` makes it, `static/` what browsers get as it was
//! written. A browser that has them asks nobody else for anything.

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
            bytes: include_bytes!("../static/favicon.svg"),
            media_type: "image/svg+xml",
        },
    ),
    (
        "graph.html",
        File {
            bytes: include_bytes!("../static/graph.html"),
            media_type: "text/html; charset=utf-8",
        },
    ),
    (
        "graph.js",
        File {
            bytes: include_bytes!("../static/graph.js"),
            media_type: "text/javascript; charset=utf-8",
        },
    ),
    (
        "index.html",
        File {
            bytes: include_bytes!("../dist/index.html"),
            media_type: "text/html; charset=utf-8",
        },
    ),
    (
        "page.css",
        File {
            bytes: include_bytes!("../dist/page.css"),
            media_type: "text/css; charset=utf-8",
        },
    ),
    (
        "page.js",
        File {
            bytes: include_bytes!("../dist/page.js"),
            media_type: "text/javascript; charset=utf-8",
        },
    ),
    // Its terms: wherever the page goes, they go.
    (
        "uplot-license.txt",
        File {
            bytes: include_bytes!("../static/uplot-license.txt"),
            media_type: "text/plain; charset=utf-8",
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
    fn every_file_of_the_folders_is_embedded() {
        let mut names: Vec<String> = ["dist", "static"]
            .iter()
            .flat_map(|folder| {
                std::fs::read_dir(format!("{}/{folder}", env!("CARGO_MANIFEST_DIR")))
                    .expect("the folder is part of the crate")
            })
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
        for name in ["graph.html", "index.html", "page.css"] {
            let page = file(name).expect("it is embedded");
            let text = std::str::from_utf8(page.bytes).expect("it is text");
            assert!(
                !text.contains("http:") && !text.contains("https:"),
                "{name}"
            );
        }
        assert_eq!(file("/graph.html"), None);
    }

    #[test]
    fn the_robots_page_lets_only_the_robots_own_scripts_run() {
        let page = file("index.html").expect("it is embedded");
        let text = std::str::from_utf8(page.bytes).expect("it is text");
        let policy = "default-src 'none'; script-src 'self'; style-src 'self'";
        assert!(text.contains(policy) && text.contains("connect-src 'self'"));
        // All scripts are files of their own: the policy forbids others.
        let scripts = text.matches("<script").count();
        assert!(scripts > 0 && scripts == text.matches("src=\"./page.js\"").count());
        assert_eq!(page.media_type, "text/html; charset=utf-8");
    }
}
