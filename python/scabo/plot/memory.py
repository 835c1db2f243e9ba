"""Memory of NumPy's BLAS. OpenBLAS takes its buffer in the first product of matrices; where a limit of the address space (`ulimit -v`)
leaves no room for it, it waits for ever. So the room is checked, and the buffer taken, before the work."""
import mmap

BUFFER = 128 << 20  # bytes, of one thread: OpenBLAS on x86-64. `scabo` asks for one thread where memory is limited
WORK = 16 << 20


def take_blas_buffer():
    """Raises MemoryError where there is no room. Call it after all imports, which take address space as well."""
    import numpy
    try:
        mmap.mmap(-1, BUFFER + WORK).close()
    except OSError as error:
        raise MemoryError from error
    square = numpy.ones((64, 64))
    numpy.dot(square, square)


def is_shortage(error):
    """Whether a module was not imported because its library found no room."""
    return any(text in str(error) for text in ("failed to map segment", "annot allocate memory"))
