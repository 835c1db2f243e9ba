// What the help of the program says below the options of each command.
#pragma once

namespace scabo::app {

inline constexpr const char* exit_statuses = R"(Exit status:
  0    solved and certified
  1    the command line, the model file or a file it names is wrong
  2    the solve did not converge, the loads exceed what supports and contact can carry (status `mechanism`), bodies
       fall before the loads are reached (`collapse`), or a problem file has no solution (`infeasible`); the results of
       the converged increments are kept
  3    any other failure: results cannot be written, another run writes into the same directory, memory is
       insufficient, or the program has a bug
  130  interrupted by Ctrl-C after an increment (143: by SIGTERM, 129: by SIGHUP); the finished increments are kept
If standard output cannot be written (it is closed, or a pipe without a reader), the status of `run` does not change;
the other commands, whose result is the text they print, end with status 3.)";

inline constexpr const char* run_example = R"(Example:
  scabo run model.yaml -o friction_0.5 --set contacts.joint.friction=0.5

Results: summary.json, contact.csv, fields.pvd (ParaView) and log.txt in DIR.
Ctrl-C ends the run after the current increment, or at once if none has begun; a second Ctrl-C ends it immediately.)";

inline constexpr const char* resume_example = R"(Example:
  scabo resume model.results

Continues after the last increment in the checkpoint of DIR. With the same number of threads, on the same kind of
processor, the results are those of a run without interruption, bit by bit. The model and its files must not have
changed.)";

inline constexpr const char* sweep_example = R"(Example:
  scabo sweep model.yaml --vary contacts.joint.friction=0.1:0.9:9 --vary width=1,2,4 -j 4

A path is one of the model file, as for --set, or the name of one of its parameters. Values are a list (0.1,0.2,0.5), equally spaced (0.1:0.9:9) or of equal ratio (log:1e-3:1:4). All combinations are run,
each in a directory point_001, ... of DIR; DIR/sweep.csv is the table of all points. Ctrl-C ends the runs after their
current increments, and the same command goes on with what is missing. Exit status: 0 if every point is solved; 2 if
some did not converge or are mechanisms, 1 if a value is wrong for the model, 3 if some failed.)";

inline constexpr const char* check_example = R"(Example:
  scabo check model.yaml --set bodies.upper.mesh.size=0.1)";

inline constexpr const char* exponents_example = R"(Example:
  scabo exponents notch.yaml --set bodies.plate.mesh.order=8

Displacements grow as xi^exponent from the scaling centre; exponents below 1 mean infinite stress there.)";

inline constexpr const char* contact_example = R"(Example:
  scabo contact model.results/problems/press_3.hdf5 --json > solution.json

FILE is HDF5 in FCLIB's layout, in local or global form, or text in the layout of Siconos. Exit status 0: solved, that
is, the natural-map residual or the certificate is below the tolerance; 2: not converged, a mechanism, a collapse, or
infeasible.)";

inline constexpr const char* plot_example = R"(Example:
  scabo plot model.results --what contact --units m,N -o contact.pdf

`stress`: any component of stress or displacement on the deformed bodies; `contact`: pressure, shear, gap and slip along
the contacts with the state of every pair; `history`: curves over the increments; `convergence` of the contact solver;
`mesh`. Of the directory of a sweep: quantities over the varied values, --component names columns of its table.
It needs Python with NumPy and Matplotlib (apt install python3-matplotlib).)";

inline constexpr const char* report_example = R"(Example:
  scabo report model.results --units m,N

One HTML file for any browser, without a network: the fields to zoom, pick and deform, curves along the contacts linked
with them, increments, convergence, certificate and warnings. It needs Python with NumPy (apt install python3-numpy).)";

inline constexpr const char* new_example = R"(Example:
  scabo new beam && scabo run beam.yaml && scabo plot beam.results)";

inline constexpr const char* convert_example = R"(Example:
  scabo convert part.inp && scabo run part.yaml

DECK is an input file of Abaqus or CalculiX with plane elements. The mesh goes into a file beside the model. What is
not taken is named with its line. Exit status 0: the model is that of the deck; 1: it would not be, and is not written.)";

inline constexpr const char* completion_example = R"(Example:
  source <(scabo completion bash)

`make install` and the package install the scripts of all shells.)";

inline constexpr const char* schema_example = R"(Example:
  scabo schema > model.schema.json
With `# yaml-language-server: $schema=model.schema.json` as its first line, editors complete and check a model.)";

}  // namespace scabo::app
