//! Functions of the library by name, for validation/run.py.
//!
//! Reads `[{"function": name, "arguments": [argument, …]}, …]` from standard input and writes a list of lists: the value of
//! the function at each argument. A value that cannot be computed is `{"error": text}`.

mod functions;

use serde_json::{Value, json};
use std::io::Read;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut text = String::new();
    let answer = std::io::stdin().read_to_string(&mut text).map_err(|e| e.to_string()).and_then(|_| answer(&text));
    match answer {
        Ok(values) => {
            println!("{values}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn answer(text: &str) -> Result<Value, String> {
    let requests: Vec<Value> = serde_json::from_str(text).map_err(|e| e.to_string())?;
    requests.iter().map(evaluate).collect::<Result<_, _>>().map(Value::Array)
}

fn evaluate(request: &Value) -> Result<Value, String> {
    let name = request["function"].as_str().ok_or("a request without the name of a function")?;
    let function = functions::by_name(name).ok_or_else(|| format!("no function {name:?}"))?;
    let arguments = request["arguments"].as_array().ok_or("a request without a list of arguments")?;
    let value = |argument| function(argument).unwrap_or_else(|error| json!({ "error": error.to_string() }));
    Ok(arguments.iter().map(value).collect())
}
