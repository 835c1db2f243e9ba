"""What a program says. Its results are files: where the screen cannot be written, they are complete all the same."""
import os
import sys


def complain(program, message):
    write(sys.stderr, f"{program}: {message}")


def show(program, path, what):
    """The name of a file that was written; `what` are the results."""
    if error := write(sys.stdout, path):
        complain(program, f"warning: cannot write to standard output: {error.strerror}; {what} nevertheless complete")


def write(stream, text):
    """The error, if there is one. After it the stream leads nowhere: what is left in its buffer would be an error again."""
    try:
        print(text, file=stream, flush=True)
    except OSError as error:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
        return error
    return None
