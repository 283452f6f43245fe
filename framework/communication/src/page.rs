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

/// What a page may ask for, and whom: this server, and the robots that it was told of.
fn policy(peers: &[String]) -> String {
    let peers: String = peers.iter().map(|peer| format!(" ws://{peer}")).collect();
    format!(
        "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; connect-src 'self'{peers}; frame-ancestors 'none'"
    )
}

/// The answer to `GET path`. `peers` are hosts with ports and nothing else.
pub(crate) fn file(path: &str, root: Option<&Path>, peers: &[String]) -> Response {
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
        (CONTENT_TYPE, media_type.to_owned()),
        (CONTENT_SECURITY_POLICY, policy(peers)),
        (X_CONTENT_TYPE_OPTIONS, "nosniff".to_owned()),
        // The next robot at this address may have another page.
        (CACHE_CONTROL, "no-cache".to_owned()),
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
        let status = |path: &str| file(path, Some(&root), &[]).status();
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
        let response = file("/favicon.svg", None, &[]);
        assert_eq!(response.status(), StatusCode::OK);
        assert_eq!(response.headers()[CONTENT_TYPE], "image/svg+xml");
    }

    #[test]
    fn a_page_may_talk_to_its_own_robot_and_to_those_that_were_named() {
        let allowed = |peers: &[String]| {
            let response = file("/", None, peers);
            let policy = response.headers()[CONTENT_SECURITY_POLICY].to_str();
            let policy = policy.expect("it is text").to_owned();
            let connect = policy
                .split("; ")
                .find(|part| part.starts_with("connect-src"));
            connect.expect("it says so").to_owned()
        };
        assert_eq!(allowed(&[]), "connect-src 'self'");
        let peers = ["10.1.24.22:4857".to_owned(), "[::1]:4858".to_owned()];
        assert_eq!(
            allowed(&peers),
            "connect-src 'self' ws://10.1.24.22:4857 ws://[::1]:4858"
        );
    }
}
