//! `src/bin/<target>.rs`.

use proc_macro2::Literal;
use quote::quote;

use super::layout;
use super::spelling::path;
use crate::model::Binary;

/// The binary of one target.
pub(super) fn render_binary(binary: &Binary) -> String {
    let Binary {
        name,
        robot,
        parameters,
        identities,
        recording_budget,
        manifest,
        ..
    } = binary;
    let hardware = path(&binary.hardware);
    let library = path(&format!("{}::runtime", binary.library));
    let replayables = path(&format!("{}::recording", binary.library));
    let budget = Literal::u64_unsuffixed(*recording_budget);
    let location = match &binary.location {
        Some(location) => quote!(Some(#location)),
        None => quote!(None),
    };
    let items = quote! {
        const TARGET: ::framework::Target = ::framework::Target {
            robot: #robot,
            name: #name,
            parameters: #parameters,
            location: #location,
            identities: &[#(#identities),*],
            graph: include_str!("../../graph.json"),
            recording_budget: #budget,
            manifest: include_str!(#manifest),
            dataflow: include_str!("../../DATAFLOW.md"),
            replayables: #replayables::INSTANCES,
        };

        fn main() -> ::std::process::ExitCode {
            ::framework::launch::main::<#hardware, _>(
                TARGET,
                #library::create,
                ::hulkgen_communication::serve,
            )
        }
    };
    let title = format!("The robot `{robot}` on target `{name}`.");
    let modules = [
        format!("{}::recording", binary.library),
        format!("{}::runtime", binary.library),
        "framework::launch".to_owned(),
    ];
    layout::rust_file(&title, &modules, items)
}
