//! The files of the page: those in the program, or those of a folder.

use std::fs;
use std::path::{Component, Path};

use axum::http::StatusCode;
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, X_CONTENT_TYPE_OPTIONS,
};
use axum::response::{IntoResponse, Response};

/// What `/` shows.
const FIRST: &str = "index.html";

/// The page asks this server alone for anything.
const POLICY: &str = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; connect-src 'self' ws: wss:; frame-ancestors 'none'";

/// The answer to `GET path`.
pub(crate) fn file(path: &str, root: Option<&Path>) -> Response {
    let path = match path.trim_start_matches('/') {
        "" => FIRST,
        path => path,
    };
    let found = match root {
        Some(root) => read(root, path).map(|bytes| (bytes, media_type(path))),
        None => web::file(path).map(|file| (file.bytes.to_vec(), file.media_type)),
    };
    let Some((bytes, media_type)) = found else {
        return (StatusCode::NOT_FOUND, "no such file").into_response();
    };
    let headers = [
        (CONTENT_TYPE, media_type),
        (CONTENT_SECURITY_POLICY, POLICY),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        // The next robot at this address may have another page.
        (CACHE_CONTROL, "no-cache"),
    ];
    (headers, bytes).into_response()
}

/// A file below the root; nothing above it.
fn read(root: &Path, path: &str) -> Option<Vec<u8>> {
    let path = Path::new(path);
    let is_below = path
        .components()
        .all(|component| matches!(component, Component::Normal(_)));
    is_below.then(|| fs::read(root.join(path)).ok()).flatten()
}

fn media_type(path: &str) -> &'static str {
    match path.rsplit_once('.').map(|(_, extension)| extension) {
        Some("css") => "text/css; charset=utf-8",
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("json" | "map") => "application/json",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("wasm") => "application/wasm",
        Some("woff2") => "font/woff2",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_hands_out_its_own_files_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path().join("root");
        fs::create_dir(&root).expect("a folder");
        fs::write(root.join("index.html"), "page").expect("a file");
        fs::write(folder.path().join("secret"), "secret").expect("a file");
        let status = |path: &str| file(path, Some(&root)).status();
        assert_eq!(status("/"), StatusCode::OK);
        assert_eq!(status("/index.html"), StatusCode::OK);
        for path in ["/../secret", "/./../secret", "/none", "//secret"] {
            assert_eq!(status(path), StatusCode::NOT_FOUND, "{path}");
        }
        let absolute = format!("/{}", folder.path().join("secret").display());
        assert_eq!(status(&absolute), StatusCode::NOT_FOUND);
    }

    #[test]
    fn files_of_the_program_have_their_media_types() {
        let response = file("/favicon.svg", None);
        assert_eq!(response.status(), StatusCode::OK);
        assert_eq!(response.headers()[CONTENT_TYPE], "image/svg+xml");
    }
}
